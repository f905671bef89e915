#include "app/editing/placing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "formats/ray/write/transform.h"
#include "shading/cameras/camera.h"

namespace trace::test {
namespace {

void expectNear(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

const Affine kPlaced = Affine::translation({1, 2, 3}) * Affine::scaling({2, 1, 1});

TEST(Placing, TurnsAboutTheObjectsOrigin) {
  const Affine once = turned(kPlaced, {0, 0, 90});
  expectNear(once.offset, {1, 2, 3});
  expectNear(once * Vec3{1, 0, 0}, {1, 4, 3});
  EXPECT_EQ(turned(kPlaced, {}), kPlaced);
}

TEST(Placing, StretchesAlongTheObjectsAxes) {
  expectNear(stretched(kPlaced, {3, 1, 1}) * Vec3{1, 0, 0}, {7, 2, 3});
  expectNear(stretched(kPlaced, {-1, 1, 1}) * Vec3{1, 0, 0}, {-1, 2, 3});
}

TEST(Placing, TakesNoFactorThatLosesTheObject) {
  const Real infinite = std::numeric_limits<Real>::infinity(), none = std::numeric_limits<Real>::quiet_NaN();
  for (const Real factor : {0.0, infinite, -infinite, none, 1e300, 1e-300})
    EXPECT_FALSE(isFactor(factor)) << factor;
  for (const Real factor : {1.0, -2.0, 1e-6, 1e6}) EXPECT_TRUE(isFactor(factor)) << factor;
}

TEST(Placing, TakesNoMatrixThatLosesTheObject) {
  const Real infinite = std::numeric_limits<Real>::infinity(), none = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_TRUE(keepsObject(Affine::scaling({1, 2, 3})));
  for (const Real x : {0.0, infinite, -infinite, none}) {
    Affine typed = kPlaced;
    typed.row[0].x = x;
    EXPECT_FALSE(keepsObject(typed)) << x;
  }
  Affine flat = kPlaced;
  flat.row[1] = flat.row[0];
  EXPECT_FALSE(keepsObject(flat));
  Affine gone = kPlaced;
  gone.offset.x = infinite;
  EXPECT_FALSE(keepsObject(gone));
}

TEST(Placing, ANewObjectStandsOnWhatTheCameraLooksAt) {
  Camera camera;
  camera.position = {0, 3, 6}, camera.viewdir = {0, -3, -6}, camera.fov = 40;
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  const Box3 unit{{-1, -1, -1}, {1, 1, 1}};
  SurfacePoint floor{};
  floor.normal = floor.shading = {0, 1, 0};
  const Affine on = placedInSight(unit, view, camera.updir, floor, 5);
  const Box3 box = on * unit;
  EXPECT_NEAR(box.low.y, 0, 1e-12);
  EXPECT_NEAR(box.center().x, 0, 1e-12);
  EXPECT_NEAR(box.center().z, 0, 1e-12);
  // A quarter of what the camera sees there, from bottom to top.
  EXPECT_NEAR(box.size().y, 0.25 * 2 * std::tan(20 * kPi / 180) * std::sqrt(45.0), 1e-9);
  // The scene a thousand times as large: so is the object.
  camera.position = camera.position * 1000;
  const CameraFrame far = frame(camera, CameraAxes::orthonormal);
  EXPECT_NEAR((placedInSight(unit, far, camera.updir, floor, 5) * unit).size().y, 1000 * box.size().y, 1e-6);
}

TEST(Placing, ANewObjectIsBeforeAWallAndInTheAirIfThereIsNothing) {
  Camera camera;
  camera.position = {0, 0, 6}, camera.viewdir = {0, 0, -1};
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  const Box3 unit{{-1, -1, -1}, {1, 1, 1}};
  SurfacePoint wall{};
  wall.normal = wall.shading = {0, 0, -1};  // its other side is seen
  EXPECT_NEAR((placedInSight(unit, view, camera.updir, wall, 5) * unit).low.z, 0, 1e-12);
  expectNear((placedInSight(unit, view, camera.updir, {}, 5) * unit).center(), {0, 0, 1});
  const Box3 endless{{-kInfinity, -kInfinity, 0}, {kInfinity, kInfinity, 0}};
  EXPECT_EQ(placedInSight(endless, view, camera.updir, wall, 5), Affine{});
}

TEST(Placing, ANewObjectStandsBesideOthersAndNotInThem) {
  Camera camera;
  camera.position = {0, 3, 6}, camera.viewdir = {0, -3, -6};
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  const Box3 own{{-1, 0, -1}, {1, 2, 1}}, floor{{-30, 0, -30}, {30, 0, 30}}, room{{-9, -1, -9}, {9, 9, 9}},
      ball{{-0.5, 0, -0.5}, {1.5, 2, 1.5}};
  EXPECT_EQ(freedFrom({floor, room}, own, view, camera.updir), Vec3{});
  const Vec3 by = freedFrom({floor, room, ball}, own, view, camera.updir);
  EXPECT_NE(by, Vec3{});
  EXPECT_NEAR(by.y, 0, 1e-12);
  EXPECT_TRUE(own.low.x + by.x >= ball.high.x - 0.02 || own.high.x + by.x <= ball.low.x + 0.02);
  // Where all sides are taken it goes on top.
  const Box3 wide{{-40, 0, -40}, {40, 1, 40}};
  EXPECT_GE(freedFrom({wide}, own, view, camera.updir).y, 0.9);
}

TEST(Placing, APlaceInShortNumbersIsTheSamePlace) {
  const Affine turn = upright(rowCalled<ShapeType>("cone"), {0, 1, 0});
  for (const Real factor : {1.0, 0.46016123456, 1234.56789})
    for (const Vec3& at : {Vec3{}, Vec3{-0.893634567, 0, 0.53428123}, Vec3{1e-17, 0.3, -40.123456789}}) {
      const Affine placed = Affine::translation(at) * Affine::scaling(Vec3(1, 1, 1) * factor) * turn;
      const Affine said = rayfile::inShortNumbers(placed, 5);
      for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 1, 0}})
        EXPECT_LE(length(said * p - placed * p), 6e-5 * (factor + length(at)));
      const std::vector<rayfile::TransformStep> steps = rayfile::stepsOf(said);
      for (const rayfile::TransformStep& step : steps)
        EXPECT_NE(step.kind, rayfile::TransformStep::Kind::matrix);
    }
}

TEST(Placing, ANewObjectStandsOnTheFloorBesideOthersAndIsSeenWhole) {
  Camera camera;
  camera.position = {0, 3, 8}, camera.viewdir = {0, -2, -8}, camera.fov = 40;
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  const Box3 unit{{-1, -1, -1}, {1, 1, 1}}, floor{{-30, 0, -30}, {30, 0, 30}};
  std::vector<Box3> others{floor, {{-1, 0, -1}, {1, 2, 1}}};
  const auto lookAt = [&](const Vec2& place) -> std::optional<SeenObject> {
    const Ray ray = view.ray(place);
    std::optional<SeenObject> nearest;
    Real least = kInfinity;
    for (const Box3& box : others) {  // their upper sides
      const Real t = (box.high.y - ray.origin.y) / ray.direction.y;
      const Vec3 at = ray.at(t);
      if (!(t > 0 && t < least) || at.x < box.low.x || at.x > box.high.x || at.z < box.low.z ||
          at.z > box.high.z)
        continue;
      least = t;
      nearest = SeenObject{{}, box};
      nearest->surface.point = at;
      nearest->surface.normal = {0, 1, 0};
    }
    return nearest;
  };
  for (int i = 0; i < 5; ++i) {  // five, one after the other
    const auto placed = placedAmong(unit, view, camera.updir, others, lookAt);
    ASSERT_TRUE(placed) << i;
    const Box3 own = *placed * unit;
    EXPECT_NEAR(own.low.y, 0, 1e-9) << i;
    for (std::size_t k = 1; k < others.size(); ++k) {
      const Box3& other = others[k];
      EXPECT_TRUE(own.low.x > other.high.x - 0.05 || own.high.x < other.low.x + 0.05 ||
                  own.low.z > other.high.z - 0.05 || own.high.z < other.low.z + 0.05)
          << i << " in " << k;
    }
    for (const Vec3& corner : {own.low, own.high}) {
      const auto place = view.placeOf(corner);
      ASSERT_TRUE(place) << i;
      EXPECT_TRUE(place->x > 0 && place->x < 1 && place->y > 0 && place->y < 1) << i;
    }
    others.push_back(own);
  }
  EXPECT_FALSE(placedAmong(unit, view, camera.updir, others, [](const Vec2&) { return std::nullopt; }));
}

TEST(Placing, ANewObjectDoesNotHangBelowABall) {
  Camera camera;
  camera.position = {0, 1.6, 7}, camera.viewdir = {0, -0.7, -7}, camera.fov = 30;
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  // Nothing but the lower side of a ball, which the camera sees from a distance.
  const auto lookAt = [&](const Vec2& place) -> std::optional<SeenObject> {
    if (length(Vec3{place.x, place.y, 0} - Vec3{0.3, 0.3, 0}) > 0.1) return {};
    SeenObject seen{{}, {{-2.1, 0, -1}, {-0.1, 2, 1}}};
    seen.surface.point = {-0.89, 0.18, 0.53};
    seen.surface.normal = seen.surface.shading = {0.21, -0.82, 0.53};
    return seen;
  };
  EXPECT_FALSE(placedAmong({{-1, -1, -1}, {1, 1, 1}}, view, camera.updir, {}, lookAt));
}

TEST(Placing, ShapesAlongTheirZAxisStand) {
  for (const Vec3& updir : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0.1, -1, 0)}) {
    const Affine turn = upright(rowCalled<ShapeType>("cone"), updir);
    const Vec3 axis = turn * Vec3(0, 0, 1);
    EXPECT_GT(dot(axis, normalize(updir)), 0.99) << updir.x << " " << updir.y << " " << updir.z;
  }
  std::set<std::string_view> turned;
  for (const ShapeType& type : shapeTypes())
    if (upright(type, {0, 1, 0}) != Affine{}) turned.insert(type.keyword);
  EXPECT_EQ(turned, (std::set<std::string_view>{"cone", "conic", "cylinder", "elliptic_cone", "hyperboloid",
                                                "lathe", "paraboloid", "two_sheets"}));
}

TEST(Placing, ANewLightIsAboveAndToTheLeftAndBrightEnough) {
  Camera camera;
  camera.position = {0, 1, 10}, camera.viewdir = {0, 0, -1};
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  const Vec3 target{0, 1, 0}, place = placeOfLight(view, camera.updir, target);
  EXPECT_GT(place.y, 4);
  EXPECT_LT(place.x, -2);
  EXPECT_GT(place.z, 0.5);
  for (const char* keyword : {"point_light", "spot_light", "rectangle_light"}) {
    Light light(rowCalled<LightType>(keyword));
    aimLight(light, place, target);
    EXPECT_EQ(*light.position(), place) << keyword;
    const auto arriving = light.illuminate(target, Rules{});
    ASSERT_TRUE(arriving) << keyword;
    EXPECT_GT(maxComponent(arriving->intensity()), 0.3) << keyword;
    EXPECT_LT(maxComponent(arriving->intensity()), 5) << keyword;
  }
  Light sun(rowCalled<LightType>("directional_light"));
  aimLight(sun, place, target);
  EXPECT_EQ(*sun.direction(), target - place);
}

TEST(Placing, TakesNoCameraThatSeesNothing) {
  const auto sees = [](auto&& change) {
    Camera camera;
    change(camera);
    return cameraSees(camera);
  };
  EXPECT_TRUE(sees([](Camera&) {}));
  EXPECT_TRUE(sees([](Camera& c) { c.fov = 0.001; }));
  EXPECT_FALSE(sees([](Camera& c) { c.fov = 0; }));
  EXPECT_FALSE(sees([](Camera& c) { c.fov = 180; }));
  EXPECT_FALSE(sees([](Camera& c) { c.aspectratio = 0; }));
  EXPECT_FALSE(sees([](Camera& c) { c.updir = {}; }));
  EXPECT_FALSE(sees([](Camera& c) { c.viewdir = c.updir; }));
}

TEST(Placing, ANewObjectIsLetDownOntoTheFloor) {
  const Box3 own{{-1, 2, -1}, {1, 4, 1}};
  const auto floor = [](const Ray& ray) { return std::optional<Real>(ray.origin.y / -ray.direction.y); };
  expectNear(letDown(own, {0, 1, 0.2}, floor), {0, -2, 0});
  const auto nothing = [](const Ray&) { return std::optional<Real>(); };
  expectNear(letDown(own, {0, 1, 0}, nothing), {});
  const auto within = [](const Ray&) { return std::optional<Real>(0.5); };
  expectNear(letDown(own, {0, 1, 0}, within), {});
}

TEST(Placing, AScaledObjectKeepsItsFoot) {
  const Box3 was{{-1, 0, -1}, {1, 2, 1}}, is{{-1, -1, -1}, {1, 3, 1}};
  expectNear(onItsFoot(was, {}, is, {0, 1, 0}).offset, {0, 1, 0});
  expectNear(onItsFoot(was, {}, is, {0, -1, 0}).offset, {0, -1, 0});  // what is up there is down
  EXPECT_EQ(onItsFoot({}, kPlaced, is, {0, 1, 0}), kPlaced);
}

TEST(Placing, ACopyStaysInThePictureWhereItCan) {
  Camera camera;
  camera.position = {0, 1, 10}, camera.viewdir = {0, 0, -1}, camera.fov = 40;
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  const Box3 right{{2.4, 0, -1}, {4.4, 2, 1}};  // a copy to its right would leave the picture
  EXPECT_LT(freedFrom({right}, right, view, camera.updir).x, 0);
  const Box3 left{{-4.4, 0, -1}, {-2.4, 2, 1}};
  EXPECT_GT(freedFrom({left}, left, view, camera.updir).x, 0);
}

}  // namespace
}  // namespace trace::test
