// Rays and the compiled world: the hierarchy against brute force, and rays that start from surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/supertoroid.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/traced.h"
#include "shading/lights/directional_light.h"
#include "support/scenes.h"

namespace trace::test::world_test {
namespace {

Ray rayThrough(Random& random, double scale) {
  return {random.inCube(3 * scale), normalize(random.inCube(1.5 * scale) - random.inCube(1.5 * scale))};
}

// In each of 20 scenes.
const int kRays = thorough() ? 10000 : kSanitized ? 1000 : 4000;

TEST(World, HierarchyFindsWhatBruteForceFinds) {
  Random random(1);
  Statistics statistics;
  int hits = 0;
  for (int s = 0; s < 20; ++s) {
    const Scene scene = randomScene(random, 12);
    const World fast = build(scene), slow = build(scene, {.accel = Accel::none});
    for (int i = 0; i < kRays; ++i) {
      const Ray ray = rayThrough(random, 1);
      const auto a = fast.closest(ray, Faces::both, statistics),
                 b = slow.closest(ray, Faces::both, statistics);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      ++hits;
      ASSERT_EQ(a->t, b->t);
      ASSERT_EQ(a->object, b->object);
      ASSERT_EQ(a->part, b->part);
    }
  }
  EXPECT_GT(hits, kRays);
}

TEST(World, RaysTogetherHitWhatTheyHitAlone) {
  Random random(11);
  for (int s = 0; s < 20; ++s) {
    const World world =
        build(randomScene(random, s % 2 ? 3 : 12));  // without and with a hierarchy of objects
    for (int k = 0; k < kRays / 8; ++k) {
      std::array<Ray, RayPacket::kRays> rays;
      const Ray middle = rayThrough(random, 1);
      for (Ray& ray : rays) ray = {middle.origin, middle.direction + random.inCube(k % 4 ? 0.02 : 1)};
      const Faces faces = k % 8 == 1 ? Faces::front : Faces::both;
      const std::size_t count = k % 16 == 2 ? 5 : rays.size();
      std::array<Found, RayPacket::kRays> together;
      std::array<const Ray*, RayPacket::kRays> asked;
      std::array<Found*, RayPacket::kRays> found;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        asked[i] = &rays[i];
        found[i] = &together[i];
      }
      Statistics statistics;
      world.closest(std::span(asked).first(count), faces, statistics, found);
      for (std::size_t i = 0; i < count; ++i) {
        const auto alone = world.closest(rays[i], faces, statistics);
        ASSERT_EQ(together[i].t < kInfinity, alone.has_value());
        if (!alone) continue;
        EXPECT_EQ(together[i].t, alone->t);
        EXPECT_EQ(together[i].object, alone->object);
        EXPECT_EQ(together[i].part, alone->part);
        if (!world.meshTree(alone->object)) continue;
        const TriangleHit &a = alone->triangle, &b = together[i].triangle;
        EXPECT_TRUE(std::equal(std::begin(a.b), std::end(a.b), b.b) && a.front == b.front);
      }
    }
  }
}

TEST(World, AllCrossingsAreThoseOfBruteForce) {
  Random random(2);
  Statistics statistics;
  for (int s = 0; s < 5; ++s) {
    const Scene scene = randomScene(random, 12);
    const World fast = build(scene), slow = build(scene, {.accel = Accel::none});
    for (int i = 0; i < 5000; ++i) {
      const Ray ray = rayThrough(random, 1);
      const Real tMost = random.coin() ? kInfinity : random.uniform(0, 5);
      const auto collect = [&](const World& world) {
        std::vector<Found> found;
        world.crossings(ray, tMost, Faces::both, statistics,
                        [&](const Found& f) { return found.push_back(f), false; });
        std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.before(b); });
        const auto same = [](const Found& a, const Found& b) { return !a.before(b) && !b.before(a); };
        found.erase(std::unique(found.begin(), found.end(), same), found.end());  // parts of a triangle
        return found;
      };
      const auto a = collect(fast), b = collect(slow);
      ASSERT_EQ(a.size(), b.size());
      for (size_t k = 0; k < a.size(); ++k) {
        ASSERT_TRUE(a[k].t == b[k].t && a[k].object == b[k].object && a[k].part == b[k].part);
        ASSERT_LT(a[k].t, tMost);
      }
    }
  }
}

TEST(World, ARayDoesNotAskWhatItLeaves) {
  Scene scene;
  addObject(scene, Plane{}, Affine::translation({0, 0, -3}), {});
  addObject(scene, Sphere{}, {}, {});
  addObject(scene, Sphere{}, Affine::translation({0, 0, -1.5}), {});
  for (Accel accel : {Accel::bvh, Accel::none}) {
    const World world = build(scene, {.accel = accel});
    for (const std::uint32_t left : {Ray::kNothing, 0u, 1u, 2u}) {
      const Ray ray{{0, 0, 5}, {0, 0, -1}, left};
      Statistics statistics;
      EXPECT_EQ(world.closest(ray, Faces::both, statistics)->object, left == 1 ? 2u : 1u);
      std::set<std::uint32_t> crossed;
      world.crossings(ray, kInfinity, Faces::both, statistics,
                      [&](const Found& f) { return crossed.insert(f.object), false; });
      EXPECT_EQ(crossed.size(), left == Ray::kNothing ? 3u : 2u);
      EXPECT_EQ(crossed.count(left), 0u);
    }
  }
}

TEST(World, HitsLieInTheBoundsAndNormalsAreUnit) {
  Random random(4);
  Statistics statistics;
  for (int s = 0; s < 20; ++s) {
    const Scene scene = randomScene(random, 10);
    const World world = build(scene);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = rayThrough(random, 1);
      const auto found = world.closest(ray, Faces::both, statistics);
      if (!found) continue;
      const SurfacePoint surface = world.surface(ray, *found);
      const Vec3 e = surface.error;
      const Box3 padded{world.bounds().low - e, world.bounds().high + e};
      EXPECT_TRUE(padded.contains(surface.point) || scene.objects[found->object].shape.is<Plane>());
      EXPECT_NEAR(length(surface.normal), 1, 1e-14);
      EXPECT_NEAR(length(surface.shading), 1, 1e-14);
      EXPECT_LT(length(surface.point - ray.at(found->t)), 1e-11 * std::max(1.0, found->t));
    }
  }
}

TEST(World, ASphereScaledUnevenlyIsAnEllipsoid) {
  Scene scene;
  addObject(scene, Sphere{}, Affine::scaling({1, 2, 3}), {});
  const World world = build(scene);
  Statistics statistics;
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = random.direction();
    const Ray ray{d * 10, -d};
    const auto found = world.closest(ray, Faces::both, statistics);
    ASSERT_TRUE(found);
    const SurfacePoint s = world.surface(ray, *found);
    const Vec3 q{s.point.x, s.point.y / 2, s.point.z / 3};
    EXPECT_NEAR(dot(q, q), 1, 1e-14);
    const Vec3 gradient = normalize({q.x, q.y / 2, q.z / 3});
    EXPECT_LT(length(gradient - s.normal), 1e-14);
  }
}

TEST(World, StretchedSpheresAreBallsOfTheMeanRadiusIfAsked) {
  Scene scene;
  addObject(scene, Sphere{}, Affine::translation({1, 2, 3}) * Affine::scaling({1, 2, 6}), {});
  addObject(scene, Cube{}, Affine::scaling({1, 2, 6}), {});
  const World world = build(scene, {.roundSpheres = true});
  Statistics statistics;
  const auto found = world.closest({{1, 2, 20}, {0, 0, -1}}, Faces::both, statistics);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->t, 20 - (3 + 3), 1e-14);
  EXPECT_EQ(world.bounds(), (Box3{{-2, -1, -3}, {4, 5, 6}}));  // the box is as it was
}

TEST(World, RoundShapesShowOneCornerOfAPictureWhereMapsLieOnFlatOnesOnly) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  addObject(scene, Cylinder{}, Affine::translation({5, 0, 0}), {});
  addObject(scene, Cone{}, Affine::translation({10, 0, 0}), {});
  addObject(scene, Cube{}, Affine::translation({15, 0, 0}), {});
  for (const bool onRound : {true, false}) {
    const World world = build(scene, {.roundMaps = onRound});
    Statistics statistics;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const Ray ray{{5.0 * i + 0.3, 0.2, 5}, {0, 0, -1}};
      const auto found = world.closest(ray, Faces::both, statistics);
      ASSERT_TRUE(found);
      ASSERT_EQ(found->object, i);
      const TexturePlace place = world.place(Hit(world, ray, *found));
      const bool corner = place.uv.x == 0 && place.uv.y == 0;
      EXPECT_EQ(corner, !onRound && i < 3) << i;
      EXPECT_NEAR(place.point.x, 0.3, 1e-12) << "solid patterns stay";
    }
  }
}

TEST(World, AFractalSeenFromTenThousandUnitsDoesNotShadowItself) {
  // A Julia set whose constant is zero is a ball: a light behind the eye reaches all that is seen.
  Random random(1);
  Julia ball;
  ball.constant = {}, ball.iterations = 30;
  Scene scene;
  addObject(scene, ball, {}, {});
  const World world = build(scene);
  int met = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = random.direction();
    const Ray ray{random.inCube(0.7) - d * 1e4, d};
    Statistics statistics;
    const auto found = world.closest(ray, Faces::both, statistics);
    if (!found) continue;
    const SurfacePoint s = world.surface(ray, *found);
    EXPECT_NEAR(length(s.point), 1, 1e-8);
    EXPECT_GT(dot(s.normal, s.point), 0.999);
    EXPECT_FALSE(world.closest(spawnRay(s, -d), Faces::both, statistics));
    ++met;
  }
  EXPECT_GT(met, 500);
}

TEST(World, ASmallPartOfAWideSolidIsFoundAsIfItStoodAlone) {
  Random random(1);
  const Affine small = Affine::translation({1, 2, 3}) * Affine::scaling({1e-5, 1e-5, 1e-5});
  Scene alone, wide;
  addObject(alone, Supertoroid{}, small, {});
  addObject(
      wide,
      Union{Operands({{"", Supertoroid{}, small, 0}, {"", Sphere{}, Affine::translation({9, 9, 9}), 0}})}, {},
      {});
  const World one = build(alone), all = build(wide);
  const auto places = [](const World& world, const Ray& ray) {
    std::vector<SurfacePoint> found;
    Statistics statistics;
    world.crossings(ray, 8, Faces::both, statistics,
                    [&](const Found& f) { return found.push_back(world.surface(ray, f)), false; });
    std::sort(found.begin(), found.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
      return dot(a.point - b.point, ray.direction) < 0;
    });
    return found;
  };
  int met = 0, differ = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 d = random.direction();
    const Ray ray{small * random.inCube(1.2) - d * 3, d};
    const std::vector<SurfacePoint> a = places(one, ray), b = places(all, ray);
    EXPECT_EQ(b.size() % 2, 0u);
    if (a.size() != b.size()) {  // a ray that grazes it
      ++differ;
      continue;
    }
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (std::abs(dot(a[k].normal, d)) < 1e-3) continue;
      EXPECT_LT(length(a[k].point - b[k].point), 1e-12);
      EXPECT_LT(maxComponent(b[k].error), 1e-14);
    }
    met += !a.empty();
  }
  EXPECT_GT(met, 5000);
  EXPECT_LE(differ, 2);
}

TEST(World, ObjectsWithoutEndAreMetBesideTheOthers) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  addObject(scene, Plane{}, Affine::translation({0, 0, -1}), {});  // the sphere stands on it
  Statistics statistics;
  for (Accel accel : {Accel::bvh, Accel::none}) {
    const World world = build(scene, {.accel = accel});
    EXPECT_EQ(world.bounds(), (Box3{{-1, -1, -1}, {1, 1, 1}}));
    EXPECT_EQ(world.closest({{0, 0, 5}, {0, 0, -1}}, Faces::both, statistics)->object, 0u);
    const auto far = world.closest({{1e6, 0, 5}, {0, 0, -1}}, Faces::both, statistics);
    ASSERT_TRUE(far);
    EXPECT_EQ(far->object, 1u);
    EXPECT_EQ(far->t, 6);
    EXPECT_FALSE(world.closest({{9, 0, 5}, {0, 0, 1}}, Faces::both, statistics));
    int crossed = 0;
    world.crossings({{0, 0, 5}, {0, 0, -1}}, kInfinity, Faces::both, statistics,
                    [&](const Found&) { return ++crossed, false; });
    EXPECT_EQ(crossed, 3);
  }
}

TEST(World, MeshesNamedTwiceShareTheirTree) {
  Random random(6);
  Scene scene;
  const Mesh mesh{ballMesh(20, random)};
  for (int i = 0; i < 3; ++i) addObject(scene, mesh, Affine::translation({3.0 * i, 0, 0}), {});
  const World world = build(scene);
  EXPECT_EQ(world.triangleCount(), 3 * mesh.data->triangles.size());
  EXPECT_NE(world.meshTree(0), nullptr);
  EXPECT_EQ(world.meshTree(0), world.meshTree(1));
  EXPECT_EQ(world.meshTree(0), world.meshTree(2));
}

/// Meshes, with and without generated normals, in front of balls and solids that cost something to prepare.
Scene sceneToEdit() {
  Random random(7);
  Scene scene = randomScene(random, 30);
  const auto generated = ballMesh(9, random);
  generated->generateNormals = true;
  addObject(scene, Mesh{generated}, Affine::translation({-1, 0, 1}), {});
  addObject(scene, Mesh{ballMesh(12, random)}, Affine::translation({1, 0, 1}), {});
  return scene;
}

constexpr std::uint32_t kGenerated = 30, kBall = 31;  // in sceneToEdit()

TEST(World, AfterAnEditOnlyWhatChangedIsMadeAnew) {
  const Scene scene = sceneToEdit();
  const Settings settings{.width = 30};
  const World world = build(scene, settings);
  Messages messages;
  const Compiled before{scene, settings, world};
  const auto edited = [&](auto&& edit) {
    Scene other = scene;
    edit(other);
    World now = compile(other, settings, messages, &before);
    EXPECT_EQ(picture(now, settings, other.camera), picture(other, settings));
    return now;
  };
  const auto keepsTrees = [&](const World& now) {
    for (std::uint32_t i = 0; i < now.objectCount(); ++i)
      if (now.meshTree(i) != world.meshTree(i)) return false;
    return true;
  };

  const World painted = edited([](Scene& s) {
    s.materials[3].model.edit<Phong>()->transmissive = Color(0.5);
    s.materials[kBall].model.edit<Phong>()->diffuse = {1, 0, 0};
    s.lights.pop_back();
    s.camera.position.x += 1;
  });
  EXPECT_TRUE(keepsTrees(painted));
  EXPECT_EQ(&painted.hierarchy(), &world.hierarchy());

  const World moved = edited([](Scene& s) { s.objects[kBall].worldFromObject.offset.x -= 0.5; });
  EXPECT_TRUE(keepsTrees(moved));
  EXPECT_NE(&moved.hierarchy(), &world.hierarchy());

  const World fewer = edited([](Scene& s) { s.objects.erase(s.objects.begin() + 4); });
  EXPECT_EQ(fewer.meshTree(kBall - 1), world.meshTree(kBall));

  const World swapped = edited([](Scene& s) { std::swap(s.objects[2], s.objects[kBall]); });
  EXPECT_EQ(swapped.meshTree(2), world.meshTree(kBall));

  const World other = edited([](Scene& s) {
    auto data = std::make_shared<MeshData>(*s.objects[kBall].shape.as<Mesh>()->data);
    data->points[0].x += 0.25f;
    s.objects[kBall].shape = Mesh{data};
    s.objects[0].shape = Torus{};
  });
  EXPECT_NE(other.meshTree(kBall), world.meshTree(kBall));
  EXPECT_EQ(other.meshTree(kGenerated), world.meshTree(kGenerated));

  const World readAgain = edited([](Scene& s) {  // equal data elsewhere in memory
    s.objects[kBall].shape = Mesh{std::make_shared<const MeshData>(*s.objects[kBall].shape.as<Mesh>()->data)};
  });
  EXPECT_TRUE(keepsTrees(readAgain));
}

TEST(World, AChangedSolidKeepsTheTreesOfItsMeshes) {
  Random random(8);
  const std::shared_ptr<const MeshData> ball = ballMesh(12, random);
  const auto pierced = [&](Real radius) {
    const Difference inner{
        Operands({{"", Mesh{ball}, {}, 0}, {"", Cube{}, Affine::scaling({radius, 1, 9}), 0}})};
    return Union{Operands({{"", inner, {}, 0}, {"", Mesh{ball}, Affine::translation({1, 0, 0}), 0}})};
  };
  Scene scene;
  addObject(scene, pierced(0.2), {}, {});
  scene.camera.position = {0, 0, 6};
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
  scene.materials[0].model.edit<Phong>()->diffuse = Color(1);
  const Settings settings{.width = 40};
  const World world = build(scene, settings);
  const auto treesOf = [](const Shape& shape, const MeshTrees& made) {
    MeshTrees trees;
    prepare(shape, made).addMeshTrees(trees);
    return trees;
  };
  const MeshTrees first = treesOf(pierced(0.2), {});
  EXPECT_EQ(first.size(), 1u);
  EXPECT_EQ(treesOf(pierced(0.3), first), first);
  EXPECT_NE(treesOf(pierced(0.3), {}), first);

  Scene other = scene;
  other.objects[0].shape = pierced(0.3);
  Messages messages;
  const Compiled before{scene, settings, world};
  const auto holders = ball.use_count();
  const World now = compile(other, settings, messages, &before);
  EXPECT_EQ(ball.use_count(), holders + 2);  // the two operands, and no new tree
  EXPECT_EQ(picture(now, settings, other.camera), picture(other, settings));
}

TEST(World, OptionsThatConcernHierarchiesMakeThemAnew) {
  const Scene scene = sceneToEdit();
  const World world = build(scene, {.width = 30});
  const Settings settings{.width = 30};
  Messages messages;
  const Compiled before{scene, settings, world};
  const auto under = [&](const Settings& changed) {
    World now = compile(scene, changed, messages, &before);
    EXPECT_EQ(picture(now, changed, scene.camera), picture(scene, changed));
    return now;
  };
  const World slow = under({.width = 30, .accel = Accel::none});
  EXPECT_NE(slow.meshTree(kBall), world.meshTree(kBall));
  EXPECT_NE(&slow.hierarchy(), &world.hierarchy());

  const World normals = under({.width = 30, .vertexNormals = VertexNormals::mean});
  EXPECT_NE(normals.meshTree(kGenerated), world.meshTree(kGenerated));
  EXPECT_EQ(normals.meshTree(kBall), world.meshTree(kBall));

  EnumSet<ShapeKind> meshes;
  meshes.add(static_cast<ShapeKind>(Shape(Mesh{}).type().index));
  const World fewer = under({.width = 30, .omit = meshes});
  EXPECT_EQ(fewer.meshTree(kBall), nullptr);
}

TEST(World, FlatTransformsAreLeftOutWithAWarning) {
  Scene scene;
  addObject(scene, Sphere{}, Affine::scaling({1, 0, 1}), {});
  addObject(scene, Sphere{}, {}, {});
  Messages messages;
  const World world = compile(scene, {}, messages);
  ASSERT_EQ(messages.all().size(), 1u);
  Statistics statistics;
  const auto found = world.closest({{0, 0, 5}, {0, 0, -1}}, Faces::both, statistics);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->object, 1u);
  for (Accel accel : {Accel::bvh, Accel::none}) {
    Messages unused;
    const World other = compile(scene, {.accel = accel}, unused);
    EXPECT_EQ(other.closest({{0, 0.5, 5}, {0, 0, -1}}, Faces::both, statistics)->object, 1u);
  }
}

TEST(World, CameraThatCannotLookIsRefused) {
  Scene scene;
  scene.camera.updir = scene.camera.viewdir;
  EXPECT_THROW(build(scene), Error);
}

}  // namespace
}  // namespace trace::test::world_test
