// Ambient occlusion against closed forms (the share of a half space that is open, by the cosine).
#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "shading/lights/ambient_light.h"
#include "support/scenes.h"

namespace trace::test::occlusion_test {
namespace {

Affine turned(const Vec3& axis, Real angle) { return Affine::rotation(axis, angle); }

/// A small patch of a floor at the origin, seen from aslant above, and the camera.
Scene patch() {
  Scene scene;
  Phong white;
  white.ambient = Color(1);
  addObject(scene, Square{}, turned({1, 0, 0}, -kPi / 2) * Affine::scaling({0.02, 0.02, 1}), white);
  scene.camera.position = {3, 1, 0};
  scene.camera.viewdir = {-3, -1, 0};
  scene.camera.fov = 0.02;
  return scene;
}

Real mean(const Scene& scene, const Settings& settings) {
  Real sum = 0;
  const Picture seen = picture(scene, settings);
  for (const Color& c : seen.pixels) sum += c.g;
  return sum / static_cast<Real>(seen.pixels.size());
}

/// What both the integrator and the ambient light of Whitted's find.
void expectOpen(Scene scene, Real expected, Real reach = 0) {
  Settings settings;
  settings.width = settings.height = 4;
  settings.spp = 1024;
  settings.sampling = SampleKind::sobol;
  settings.occlusionReach = reach;
  settings.integrator = IntegratorKind::occlusion;
  EXPECT_NEAR(mean(scene, settings), expected, 0.004);
  settings.integrator = IntegratorKind::whitted;
  settings.spp = 64;
  settings.ambientOcclusion = 16;
  scene.lights.push_back({AmbientLight{.color = Color(1)}, {}});
  EXPECT_NEAR(mean(scene, settings), expected, 0.004);
}

/// A wall that stands at x = -1, of that height, and has no end to the sides.
Affine wall(Real height) {
  return Affine::translation({-1, height / 2, 0}) * turned({0, 1, 0}, kPi / 2) *
         Affine::scaling({1e4, height, 1});
}

TEST(Occlusion, NothingAboveLeavesAllOpen) { expectOpen(patch(), 1); }

TEST(Occlusion, AWallTakesWhatItsHeightSays) {
  for (const Real height : {0.5, 1.0, 2.0}) {
    Scene scene = patch();
    addObject(scene, Square{}, wall(height), Phong{});
    expectOpen(scene, (1 + std::cos(std::atan(height))) / 2);
  }
}

TEST(Occlusion, ABallTakesItsSolidAngleByTheCosine) {
  Scene scene = patch();
  addObject(scene, Sphere{}, Affine::translation({0, 2, 0}), Phong{});
  expectOpen(scene, 0.75);
}

TEST(Occlusion, WhatIsBeyondTheReachTakesNothing) {
  Scene scene = patch();
  addObject(scene, Sphere{}, Affine::translation({0, 2, 0}), Phong{});
  expectOpen(scene, 1, 0.99);
}

}  // namespace
}  // namespace trace::test::occlusion_test
