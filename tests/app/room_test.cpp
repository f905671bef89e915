// A room around a camera is seen into from outside.
#include "app/view/space/room.h"

#include <gtest/gtest.h>

#include "app/view/space/scene_model.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

using Walls = std::vector<std::uint32_t>;

/// A ball, and around it and the camera six walls with their faces anywhere.
Scene roomOfWalls() {
  Scene scene;
  addObject(scene, Sphere{}, Affine::scaling({0.5, 0.5, 0.5}), {});
  const Affine wall = Affine::translation({0, 0, 4}) * Affine::scaling({8, 8, 1});
  for (const Real turn : {0.0, 0.5, 1.0, 1.5})
    addObject(scene, Square{}, Affine::rotation({0, 1, 0}, turn * kPi) * wall, {});
  for (const Real turn : {0.5, -0.5})
    addObject(scene, Square{}, Affine::rotation({1, 0, 0}, turn * kPi) * wall, {});
  scene.camera.position = {0, 1, 3};
  return scene;
}

Walls wallsOf(const Scene& scene) { return wallsAround(build(scene), scene.camera.position, frameOf(scene)); }

TEST(Room, ItsWallsAreWhatEnclosesTheCamera) {
  Scene scene = roomOfWalls();
  EXPECT_EQ(wallsOf(scene), (Walls{1, 2, 3, 4, 5, 6}));
  scene.objects.pop_back();  // as a room without a ceiling, or with a large window
  EXPECT_EQ(wallsOf(scene), (Walls{1, 2, 3, 4, 5}));
  scene.objects.resize(4);
  EXPECT_TRUE(wallsOf(scene).empty());
  Scene box;
  addObject(box, Sphere{}, {}, {});
  addObject(box, Cube{}, Affine::scaling({9, 9, 9}), {});
  EXPECT_EQ(wallsOf(box), (Walls{1}));
  box.camera.position = {0, 0, 20};
  EXPECT_TRUE(wallsOf(box).empty());
}

TEST(Room, TheViewTurnsUntilARoofHidesNoHit) {
  Scene scene;
  addObject(scene, Cube{}, Affine::translation({0, 1.5, 0}) * Affine::scaling({4, 0.1, 4}), {});
  const World world = build(scene);
  Camera camera;
  camera.position = {0, 1, 9};
  const Box3 box{{-1, -1, -1}, {1, 1, 1}};
  OrbitCamera orbit(box, camera);
  orbit.turn(0, 1);  // from high above
  orbit.lookAt(box);
  const std::vector<Vec3> hits{{0, 0, 0}, {0.3, 0, 0.2}};
  const OrbitCamera turned = inSight(orbit, hits, world, {}, camera.position);
  Statistics statistics;
  for (const Vec3& hit : hits) {
    const Vec3 eye = turned.frame(1).eye;
    EXPECT_FALSE(world.closest({eye, normalize(hit - eye)}, Faces::both, statistics));
  }
  // One that sees everything stays.
  const OrbitCamera again = inSight(turned, hits, world, {}, camera.position);
  EXPECT_EQ(again.frame(1).eye, turned.frame(1).eye);
}

TEST(Room, AFloorUnderTheSkyIsNone) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  addObject(scene, Plane{}, Affine::translation({0, -1, 0}) * Affine::rotation({1, 0, 0}, kPi / 2), {});
  scene.camera.position = {0, 1, 5};
  EXPECT_TRUE(wallsOf(scene).empty());
  EXPECT_TRUE(wallsOf(Scene{}).empty());
}

TEST(Room, FromOutsideTheNearWallIsNotThereAndTheFarOneIs) {
  for (const bool box : {false, true}) {
    Scene scene = roomOfWalls();
    if (box) {
      scene.objects.resize(1);
      addObject(scene, Cube{}, Affine::scaling({8, 8, 8}), {});
    }
    const World world = build(scene);
    const Walls walls = wallsOf(scene);
    const Vec3 inside = scene.camera.position;
    for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)}) {
      const auto middle = closestShown(world, {side * 20, -side}, walls, inside);
      ASSERT_TRUE(middle);
      EXPECT_EQ(middle->object, 0u);
      EXPECT_NEAR(middle->t, 19.5, 1e-9);
      const Vec3 aside = Vec3(side.y, side.z, side.x) * 2;  // past the ball
      const auto far = closestShown(world, {side * 20 + aside, -side}, walls, inside);
      ASSERT_TRUE(far);
      EXPECT_NEAR(far->t, 24, 1e-9);
    }
    // From inside everything is there.
    const auto wall = closestShown(world, {inside, {0, 1, 0}}, walls, inside);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->t, 3, 1e-9);
  }
}

TEST(Room, AViewThatShowsRaysWellIsKnown) {
  Camera camera;
  camera.position = {0, 0, 10}, camera.viewdir = {0, 0, -1}, camera.fov = 40;
  const CameraFrame view = frame(camera, CameraAxes::orthonormal);
  const std::vector<Vec3> hits{{1, 1, 0}, {-1, 0, 0}};
  EXPECT_TRUE(showsWell(view, {{-2, -2, -1}, {2, 2, 1}}, hits));
  EXPECT_FALSE(showsWell(view, {{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}, hits)) << "a dot";
  EXPECT_FALSE(showsWell(view, {{-2, -2, -1}, {2, 2, 1}}, {{9, 0, 0}})) << "beside it";
  EXPECT_FALSE(showsWell(view, {{-2, -2, -1}, {2, 2, 20}}, hits)) << "behind the eye";
}

}  // namespace
}  // namespace trace::test
