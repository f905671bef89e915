// Instances: placements of groups are hit, lit and named as copies of their objects would be.
#include <gtest/gtest.h>

#include <set>

#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "scene/groups.h"
#include "scene/integrators.h"
#include "support/scenes.h"

namespace trace::test::instances_test {
namespace {

GroupUses usesOf(std::uint32_t group, const std::vector<Affine>& transforms) {
  auto list = std::make_shared<GroupUses::List>();
  for (const Affine& transform : transforms) list->push_back({transform, 0});
  return {group, list};
}

Affine scaled(Real size) { return Affine::scaling({size, size, size}); }
Affine mirrored(const Affine& m) { return m * Affine::scaling({-1, 1, 1}); }
Affine sheared(const Affine& m) { return m * Affine{{{1, 0.4, 0}, {0, 1, -0.3}, {0, 0, 1}}, {}}; }

/// Three placements, one mirrored and one sheared.
std::vector<Affine> threePlacements(Random& random) {
  return {random.affine(0.4), mirrored(random.affine(0.4)), sheared(random.affine(0.4))};
}

/// The scene with its objects as a group that is placed.
Scene placed(Scene scene, const std::vector<Affine>& transforms) {
  Group group{"thing", {}, std::move(scene.objects), {}};
  scene.objects.clear();
  scene.groups.push_back(std::move(group));
  scene.uses.push_back(usesOf(0, transforms));
  return scene;
}

Ray rayThrough(Random& random) {
  return {random.inCube(4), normalize(random.inCube(1.5) - random.inCube(3))};
}

bool isClose(const Vec3& a, const Vec3& b, Real limit) { return maxComponent(abs(a - b)) <= limit; }

/// How many of the rays hit both alike, and how many hit one of them.
struct Agreement {
  int alike = 0, hits = 0;
};
Agreement compare(const Scene& scene, Random& random, int rays) {
  const World instances = build(scene), copies = build(copied(scene, "test"));
  Agreement agreement;
  Statistics statistics;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = rayThrough(random);
    const auto a = instances.closest(ray, Faces::both, statistics),
               b = copies.closest(ray, Faces::both, statistics);
    if (!a && !b) continue;
    ++agreement.hits;
    if (!a || !b || std::abs(a->t - b->t) > 1e-9 * b->t) continue;
    const SurfacePoint p = instances.surface(ray, *a), q = copies.surface(ray, *b);
    const bool alike = isClose(p.point, q.point, 1e-8) && isClose(p.normal, q.normal, 1e-5) &&
                       isClose(p.shading, q.shading, 1e-5) && a->part == b->part;
    const Hit hit(instances, ray, *a), other(copies, ray, *b);
    const bool same = hit.leaving == other.leaving && hit.convex == other.convex &&
                      hit.solid == other.solid && hit.twoSided == other.twoSided &&
                      isClose(instances.place(hit).point, copies.place(other).point, 1e-6);
    agreement.alike += alike && same;
  }
  return agreement;
}

TEST(Instances, EveryShapeIsHitAsItsCopiesAre) {
  Random random(1);
  const int rays = thorough() ? 5000 : kSanitized ? 150 : 600;
  for (const Shape& shape : analyticShapes()) {
    if (check(shape).bounds.unbounded()) continue;
    Scene scene;
    addObject(scene, shape, random.affine(0.2), {});
    const Agreement agreement = compare(placed(scene, threePlacements(random)), random, rays);
    // Shapes that fold finely may turn a rounding error into another hit.
    EXPECT_GE(agreement.alike, agreement.hits - 1 - agreement.hits / 50) << nameOf(shape);
  }
}

TEST(Instances, MeshesAndNestedGroupsAreHitAsTheirCopiesAre) {
  Random random(2);
  Scene scene;
  const auto mesh = ballMesh(9, random);
  addNeedles(*mesh, random);
  addObject(scene, Mesh{mesh}, random.affine(0.2), {});
  addObject(scene, Sphere{}, random.affine(0.3), {});
  scene = placed(scene, threePlacements(random));
  Group outer{"outer", {}, {}, {usesOf(0, threePlacements(random))}};
  outer.objects.push_back({"", Cube{}, random.affine(0.2), addMaterial(scene, {}), {}});
  scene.groups.push_back(outer);
  scene.uses.push_back(usesOf(1, threePlacements(random)));
  addObject(scene, Sphere{}, Affine::scaling({0.3, 0.3, 0.3}), {});
  const Agreement agreement = compare(scene, random, 4000);
  EXPECT_GT(agreement.hits, 150);
  EXPECT_EQ(agreement.alike, agreement.hits);
}

TEST(Instances, SolidsOfSolidsAreHitAsTheirCopiesAre) {
  Random random(3);
  Scene scene;
  const auto ball = [&](const Vec3& at) {
    return Operand{"", Sphere{}, Affine::translation(at), addMaterial(scene, {})};
  };
  addObject(scene, Difference{Operands({ball({}), ball({0.7, 0.2, 0})})}, random.affine(0.3), {});
  addObject(scene, Intersection{Operands({ball({}), ball({0, 0.7, 0.4})})}, random.affine(0.3), {});
  const Agreement agreement = compare(placed(scene, threePlacements(random)), random, 3000);
  EXPECT_GT(agreement.hits, 20);
  EXPECT_EQ(agreement.alike, agreement.hits);
}

Scene forest(Random& random, int trees) {
  Scene scene;
  Phong leaf, trunk, glass;
  leaf.diffuse = {0.1, 0.6, 0.1};
  trunk.diffuse = {0.5, 0.3, 0.1};
  glass.transmissive = glass.reflective = Color(1);
  glass.index = 1.5;
  addObject(scene, Mesh{ballMesh(6, random)}, Affine::translation({0, 0.8, 0}) * scaled(0.4), leaf);
  addObject(scene, Cube{}, Affine::scaling({0.15, 1.2, 0.15}), trunk);
  addObject(scene, Sphere{}, Affine::translation({0.5, 0.3, 0.2}) * scaled(0.2), glass);
  std::vector<Affine> places;
  for (int i = 0; i < trees; ++i)
    places.push_back(
        Affine::translation({random.uniform(-2, 2), random.uniform(-1.5, 1), random.uniform(-2, 2)}) *
        scaled(random.uniform(0.5, 1)));
  scene = placed(scene, places);
  Phong floor, lamp;
  floor.diffuse = Color(0.6);
  lamp.emissive = Color(6);
  addObject(scene, Cube{}, Affine::translation({0, -2, 0}) * Affine::scaling({9, 0.2, 9}), floor);
  addObject(scene, Square{}, Affine::translation({0, 4, 0}) * Affine::rotation({1, 0, 0}, kPi / 2), lamp);
  scene.lights.push_back(
      {PointLight{.position = {2, 4, 4}, .color = Color(0.8), .constant = 1, .quadratic = 0}, {}});
  scene.camera.position = {0, 1, 7};
  scene.camera.viewdir = normalize(Vec3{0, -0.15, -1});
  return scene;
}

TEST(Instances, AllCrossingsAreThoseOfCopies) {
  Random random(4);
  const Scene scene = forest(random, 7);
  const World instances = build(scene), copies = build(copied(scene, "test")),
              slow = build(scene, {.accel = Accel::none});
  Statistics statistics;
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = rayThrough(random);
    const auto distances = [&](const World& world) {
      std::set<Real> all;
      world.crossings(ray, kInfinity, Faces::both, statistics, [&](const Found& f) {
        all.insert(f.t);
        Real own = kInfinity;
        world.crossingsOf(f.object, ray, kInfinity, statistics, [&](const Found& g) {
          EXPECT_EQ(g.object, f.object);
          own = std::min(own, std::abs(g.t - f.t));
          return false;
        });
        EXPECT_EQ(own, 0);
        return false;
      });
      return std::vector<Real>(all.begin(), all.end());
    };
    const auto a = distances(instances), b = distances(copies), c = distances(slow);
    EXPECT_EQ(a, c);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_NEAR(a[k], b[k], 1e-9 * b[k]);
    hits += !a.empty();
  }
  EXPECT_GT(hits, 200);
}

TEST(Instances, ARayThatLeavesAConvexObjectIsNotTestedAgainstThatPlacementAlone) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  scene = placed(scene, {{}, Affine::translation({0, 0, 3})});
  const World world = build(scene);
  Statistics statistics;
  const auto first = world.closest({{0, 0, -5}, {0, 0, 1}}, Faces::both, statistics);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->t, 4, 1e-12);
  Ray onward{{0, 0, 0}, {0, 0, 1}};
  onward.leaves = first->object;
  const auto second = world.closest(onward, Faces::both, statistics);
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->t, 2, 1e-12);
  EXPECT_NE(second->object, first->object);
}

TEST(Instances, NumbersOfTheSceneAreThoseOfTheWorld) {
  Random random(5);
  Scene scene = forest(random, 4);
  scene.groups.push_back({"grove", {}, {}, {usesOf(0, threePlacements(random))}});
  scene.uses.push_back(usesOf(1, threePlacements(random)));
  const World world = build(scene);
  Statistics statistics;
  std::set<std::uint32_t> met;
  for (int i = 0; i < 4000; ++i) {
    const auto found = world.closest(rayThrough(random), Faces::both, statistics);
    if (!found || !met.insert(found->object).second) continue;
    const NumberedObject object = objectOf(scene, found->object);
    ASSERT_TRUE(object.object);
    const Affine a = worldFromObject(object), b = world.worldFromObject(found->object);
    for (const Vec3& p : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
      EXPECT_TRUE(isClose(a * p, b * p, 1e-12));
    EXPECT_EQ(object.object->shape.keyword(), world.shapeOf(found->object));
    EXPECT_EQ(placementName(scene, object).empty(), found->object < scene.objects.size());
  }
  EXPECT_GT(met.size(), 20u);
}

TEST(Instances, EveryIntegratorPaintsWhatItPaintsOfCopies) {
  Random random(6);
  const Scene scene = forest(random, 6), copies = copied(scene, "test");
  for (const IntegratorRow& row : integrators()) {
    if (row.kind == IntegratorKind::cost) continue;  // instances take other steps
    Settings settings;
    settings.integrator = row.kind;
    settings.width = settings.height = kSanitized ? 8 : 24;
    settings.spp = 4;
    settings.depth = 4;
    settings.airIndex = 1;
    settings.photons = 3000;
    settings.chainStarts = 2000;
    const Picture a = picture(scene, settings), b = picture(copies, settings);
    Color meanA, meanB;
    std::size_t alike = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      meanA += a.pixels[i];
      meanB += b.pixels[i];
      alike += maxComponent(abs(Vec3{a.pixels[i].r - b.pixels[i].r, a.pixels[i].g - b.pixels[i].g,
                                     a.pixels[i].b - b.pixels[i].b})) < 1e-4;
    }
    EXPECT_GT(luminance(meanB), 0) << row.name;
    EXPECT_NEAR(luminance(meanA) / luminance(meanB), 1, 0.03) << row.name;
    // Chains and photons turn a rounding error into another path.
    if (!row.traits.has(Trait::splats) && settings.integrator != IntegratorKind::photon) {
      EXPECT_GT(alike, a.pixels.size() * 95 / 100) << row.name;
    }
    settings.threads = 1;
    const Picture one = picture(scene, settings);
    for (const int threads : {2, 7}) {
      settings.threads = threads;
      EXPECT_EQ(one.pixels, picture(scene, settings).pixels) << row.name << ", " << threads << " threads";
    }
  }
}

TEST(Instances, APlacementTakesFewBytes) {
  Random random(7);
  Scene scene;
  addObject(scene, Mesh{ballMesh(12, random)}, {}, {});
  std::vector<Affine> places;
  constexpr int kPlacements = 20000;
  for (int i = 0; i < kPlacements; ++i)
    places.push_back(Affine::translation(random.inCube(100)) * scaled(random.uniform(0.5, 1)));
  const World one = build(placed(scene, {{}})), many = build(placed(scene, places));
  EXPECT_LT(static_cast<double>(many.bytes() - one.bytes()) / kPlacements, 200);
}

TEST(Instances, TooManyObjectsAreRefused) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  scene = placed(scene, std::vector<Affine>(2000));
  for (std::uint32_t level = 0; level < 3; ++level) {
    scene.groups.push_back({"more", {}, {}, {usesOf(level, std::vector<Affine>(2000))}});
    scene.uses = {usesOf(level + 1, {{}})};
  }
  EXPECT_THROW(build(scene), Error);
  EXPECT_THROW(copied(scene, "test"), Error);
}

}  // namespace
}  // namespace trace::test::instances_test
