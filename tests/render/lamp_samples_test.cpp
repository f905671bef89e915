// Whitted's tracer asks objects that shine for their light: the same light as closed forms and `direct` give.
#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "render/picture/explain.h"
#include "shading/materials/conductor.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::lamp_samples_test {
namespace {

const Affine kFlat = Affine::rotation({1, 0, 0}, -kPi / 2);

Settings settingsOf(IntegratorKind integrator, int rays) {
  Settings settings;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = 4;
  settings.spp = 64;
  settings.lampSamples = rays;
  return settings;
}

/// A small patch of a floor at the origin, seen by a camera aslant above it.
Scene patch(const MaterialModel& floor) {
  Scene scene;
  addObject(scene, Square{}, kFlat * Affine::scaling({0.02, 0.02, 1}), {});
  scene.materials[0].model = floor;
  scene.camera.position = {3, 1, 0}, scene.camera.viewdir = {-3, -1, 0};
  scene.camera.fov = 0.02;
  return scene;
}

TEST(LampSamples, GiveTheFormFactorOfASquareAndTheSolidAngleOfABall) {
  const Settings settings = settingsOf(IntegratorKind::whitted, 16);
  Scene square = patch(diffuse(Color(1)));
  addObject(square, Square{}, Affine::translation({0, 1, 0}) * kFlat, diffuse(Color(0), 1));
  EXPECT_NEAR(meanColor(picture(square, settings)).g, 0.752275 / kPi, 0.001);
  Scene ball = patch(diffuse(Color(1)));
  addObject(ball, Sphere{}, Affine::translation({0, 2, 0}) * Affine::scaling({0.5, 0.5, 0.5}),
            diffuse(Color(0), 1));
  EXPECT_NEAR(meanColor(picture(ball, settings)).g, 1.0 / 16, 0.0002);
  EXPECT_EQ(meanColor(picture(ball, settingsOf(IntegratorKind::whitted, 0))), Color(0)) << "off";
}

TEST(LampSamples, ShadowsAreFilteredByGlass) {
  Scene scene = patch(diffuse(Color(1)));
  addObject(scene, Square{}, Affine::translation({0, 1, 0}) * kFlat, diffuse(Color(0), 1));
  const Settings settings = settingsOf(IntegratorKind::whitted, 16);
  const Color clear = meanColor(picture(scene, settings));
  Phong pane;
  pane.transmissive = {1, 0.5, 0};
  addObject(scene, Square{}, Affine::translation({0, 0.5, 0}) * kFlat * Affine::scaling({9, 9, 1}), pane);
  scene.camera.position = {3, 0.4, 0}, scene.camera.viewdir = {-3, -0.4, 0};  // under the pane
  const Color seen = meanColor(picture(scene, settings));
  EXPECT_NEAR(seen.r, clear.r, 1e-3);
  EXPECT_NEAR(seen.g, clear.g / 2, 1e-3);
  EXPECT_EQ(seen.b, 0);
}

TEST(LampSamples, WhatALobeMirrorsIsCountedOnce) {
  Conductor metal;
  metal.roughness = 0.4;
  Scene scene = patch(metal);
  addObject(scene, Sphere{}, Affine::translation({-2.2, 1, 0}) * Affine::scaling({0.6, 0.6, 0.6}),
            diffuse(Color(0), 1));
  Settings settings = settingsOf(IntegratorKind::direct, 0);
  settings.spp = 1024;
  const Real expected = meanColor(picture(scene, settings)).g;
  settings.integrator = IntegratorKind::whitted;
  settings.lampSamples = 4;
  settings.glossy = true;
  EXPECT_NEAR(meanColor(picture(scene, settings)).g / expected, 1, 0.03);
}

TEST(LampSamples, TheSameBitsForAnyNumberOfThreadsAndExplained) {
  Random random(5);
  Scene scene = randomScene(random, 12);
  addObject(scene, Square{}, Affine::translation({0, 3, -4}) * kFlat, diffuse(Color(0.5), 4));
  addObject(scene, Sphere{}, Affine::translation({-2, 1, -2}), diffuse(Color(0), 2));
  Settings settings = settingsOf(IntegratorKind::whitted, 3);
  settings.width = settings.height = 12;
  settings.spp = 4;
  const Picture one = sameForAnyThreads(scene, settings);
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  std::size_t lamps = 0;
  for (int at = 0; at < 12; at += 2) {
    const Explanation e = explain(world, *integrator, settings, {12, 12}, at, at, at % 4);
    EXPECT_EQ(e.pixel, one.at(at, at)) << at;
    EXPECT_TRUE(sumsUp(e.tree)) << at;
    for (const RayNode& node : e.tree.nodes)
      for (const Term& term : node.terms) lamps += term.kind == Term::Kind::lamp;
  }
  EXPECT_GT(lamps, 0u);
}

}  // namespace
}  // namespace trace::test::lamp_samples_test
