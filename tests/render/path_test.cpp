// Path tracing against closed forms of radiance.
#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "render/picture/explain.h"
#include "shading/lights/point_light.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::path_test {
namespace {

Settings pathSettings(int depth, int spp, int width = 16) {
  Settings settings;
  settings.integrator = IntegratorKind::path;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = width;
  settings.depth = depth, settings.spp = spp;
  return settings;
}

/// What a small patch of a floor of albedo 1 at the origin sends up to a camera aslant above it.
Real floorUnder(const Shape& lamp, const Affine& place, int spp = 1024) {
  Scene scene;
  const Affine flat = turned({1, 0, 0}, -0.5);
  addObject(scene, Square{}, flat * Affine::scaling({0.02, 0.02, 1}), diffuse(1));
  addObject(scene, lamp, place, diffuse(0, 1));
  scene.camera.position = {3, 1, 0}, scene.camera.viewdir = {-3, -1, 0};
  scene.camera.fov = 0.02;
  return mean(picture(scene, pathSettings(1, spp, 4)));
}

TEST(Path, AnEmittingRoomHasTheSumOfItsBounces) {
  for (const Real albedo : {0.2, 0.5, 0.8})
    for (const int depth : {0, 1, 3, 40}) {
      Scene scene;
      addRoom(scene, diffuse(albedo, 1));
      // The lamps of the last surface are seen directly, which is one bounce more.
      const Real expected = (1 - std::pow(albedo, depth + 2)) / (1 - albedo);
      EXPECT_NEAR(mean(picture(scene, pathSettings(depth, 128))) / expected, 1, 0.006)
          << albedo << " " << depth;
    }
}

/// Rays are recorded where a surface of any kind turns the path, and rendered where an even one does
/// (EvenPoint).
TEST(Path, WhatIsExplainedHasTheBitsOfWhatIsRendered) {
  Random random(31);
  for (int s = 0; s < 6; ++s) {
    Scene scene = randomScene(random, 12);
    if (s % 2 == 0) scene.lights.clear();
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
      Phong phong = *scene.materials[m].model.as<Phong>();
      if (m % 3 != 0) phong.specular = phong.reflective = phong.transmissive = Color(0);
      if (m % 4 == 1) phong.emissive = {2, 1, 3};
      scene.materials[m].model = phong;
    }
    if (s == 4) addCloud(scene, Sphere{}, scaled(4), 0.1);
    const Settings settings = pathSettings(5, 4);
    const World world = build(scene, settings);
    const auto integrator = integratorOf(world, settings);
    const Picture rendered = picture(scene, settings);
    for (int y = 0; y < 16; y += 3)
      for (int x = 0; x < 16; x += 3)
        EXPECT_EQ(explain(world, *integrator, settings, {16, 16}, x, y, 0).pixel,
                  rendered.pixels[static_cast<std::size_t>(y * 16 + x)]);
  }
}

TEST(Path, SquareLampLightsTheFloorByItsFormFactor) {
  const Affine above = Affine::translation({0, 1, 0}) * turned({1, 0, 0}, 0.5);
  EXPECT_NEAR(floorUnder(Square{}, above), 0.752275 / kPi, 0.001);
}

TEST(Path, AMeshLampLightsAsTheSquareDoes) {
  MeshData data;
  data.points = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
  data.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Affine above = Affine::translation({0, 1, 0}) * turned({1, 0, 0}, 0.5);
  EXPECT_NEAR(floorUnder(Mesh{std::make_shared<MeshData>(data)}, above), 0.752275 / kPi, 0.001);
}

TEST(Path, ASphereLampLightsByItsSolidAngle) {
  const Affine above = Affine::translation({0, 2, 0}) * Affine::scaling({0.5, 0.5, 0.5});
  EXPECT_NEAR(floorUnder(Sphere{}, above), 1.0 / 16, 0.0002);
}

TEST(Path, WhatIsOnlyMetByChanceGivesTheSameLight) {
  // No lamp that is known: a sphere that became an ellipsoid, thin enough to be nearly a disk of radius 1.
  const Affine flat = Affine::translation({0, 1, 0}) * Affine::scaling({1, 1e-6, 1});
  EXPECT_NEAR(floorUnder(Sphere{}, flat, 4096), 0.5, 0.005);
}

TEST(Path, GlassVanishesWhereAllIsOfOneLight) {
  Scene scene;
  Phong glass;
  glass.transmissive = glass.reflective = Color(1), glass.index = 1.5;
  addObject(scene, Sphere{}, Affine::translation({0, 0, -3}), glass);
  scene.background.gradient = {{Color(1), Color(1)}};
  Settings settings = pathSettings(200, 64);
  settings.fresnel = Fresnel::exact;
  EXPECT_NEAR(mean(picture(scene, settings)), 1, 0.005);
}

TEST(Path, LightsOfTheSceneAreThoseOfWhitted) {
  Scene scene;
  addObject(scene, Square{}, Affine::translation({0, 0, -2}) * Affine::scaling({9, 9, 1}), diffuse(0.6));
  scene.lights.push_back({PointLight{.position = {0.5, 1, 1}, .color = Color(0.8)}, {}});
  Settings settings = pathSettings(4, 1);
  settings.sampling = SampleKind::grid;
  const Picture path = picture(scene, settings);
  settings.integrator = IntegratorKind::whitted;
  EXPECT_EQ(path, picture(scene, settings)) << "nothing else shines, so nothing bounces";
}

TEST(Path, TheSameBitsForAnyNumberOfThreadsAndExplained) {
  Random random(5);
  Scene scene = randomScene(random, 12);
  addObject(scene, Square{}, Affine::translation({0, 3, -4}) * turned({1, 0, 0}, 0.5), diffuse(0.5, 4));
  Settings settings = pathSettings(6, 4, 24);
  const Picture one = sameForAnyThreads(scene, settings);
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  int bounces = 0;
  for (int at = 0; at < 24; at += 3) {
    const Explanation e = explain(world, *integrator, settings, {24, 24}, at, at, at % 4);
    EXPECT_EQ(e.pixel, one.at(at, at)) << at;
    EXPECT_TRUE(sumsUp(e.tree)) << at;
    for (const RayNode& node : e.tree.nodes) bounces += node.kind == RayKind::bounce;
  }
  EXPECT_GT(bounces, 0);
}

}  // namespace
}  // namespace trace::test::path_test
