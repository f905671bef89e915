// Emissive bodies of any shape that is sampled as a light: the densities are those of what is chosen, and
// every integrator shows their light.
#include "render/lights/body_lamp.h"

#include <gtest/gtest.h>

#include "geometry/shapes/fractals/mandelbulb.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/square.h"
#include "math/low_discrepancy.h"
#include "math/warp.h"
#include "render/lights/lamps.h"
#include "render/picture/agreement.h"
#include "render/picture/explain.h"
#include "support/bodies.h"
#include "support/rooms.h"

namespace trace::test::body_lamp_test {
namespace {

World worldOf(const Shape& shape, const Affine& place) {
  Scene scene;
  addObject(scene, shape, place, diffuse(0, 1));
  return build(scene);
}

TEST(BodyLamp, ItsDirectionsCoverWhatIsSeenOfIt) {
  constexpr std::uint32_t kRays = 1 << 14;
  for (const Body& b : bodies()) {
    const World world = worldOf(b.shape, b.place);
    const auto body = BodyLamp::of(world, 0);
    ASSERT_TRUE(body) << b.name;
    Statistics statistics;
    for (const Vec3& from : {Vec3{3, 0.2, 0.1}, Vec3{0.3, 0.7, -0.4}, Vec3{0.25, -0.1, 0.3}, Vec3{}}) {
      SCOPED_TRACE(b.name + " from " + std::to_string(from.x));
      double byBody = 0, bySphere = 0;
      for (std::uint32_t n = 0; n < kRays; ++n) {
        const Vec2 u = sobolPoint(n, 7);
        const BodyLamp::Aim aim = body->aim(from, u);
        EXPECT_NEAR(length(aim.direction), 1, 1e-12);
        EXPECT_NEAR(body->density(from, aim.direction) / aim.density, 1, 1e-8);
        if (const auto met = body->meets(world, {from, aim.direction}, statistics)) {
          EXPECT_LE(met->t, aim.farthest);
          byBody += 1 / (aim.density * kRays);
        }
        const Vec3 anywhere = sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y);
        if (body->meets(world, {from, anywhere}, statistics)) bySphere += 4 * kPi / kRays;
      }
      EXPECT_NEAR(byBody, bySphere, 0.02 * bySphere + 0.003);
    }
  }
}

TEST(BodyLamp, ItsPlacesAreSpreadEvenlyOverItsSurface) {
  constexpr std::uint32_t kLines = 1 << 18;
  for (const Body& b : bodies()) {
    SCOPED_TRACE(b.name);
    const World world = worldOf(b.shape, b.place);
    const auto body = BodyLamp::of(world, 0);
    ASSERT_TRUE(body);
    double area = 0, volume = 0;
    Vec3 normals;
    for (std::uint32_t n = 0; n < kLines; ++n)
      if (const auto at = body->place(world, sobolPoint(n, 3), sobolPointBeside(n, 3), sobolPoint(n, 9).x)) {
        const double counts = 1 / (body->perArea() * kLines);
        area += counts, normals += at->normal * counts;
        volume += dot(at->point - body->middle(), at->normal) * counts / 3;  // by the divergence theorem
      }
    if (!body->closed()) area /= 2;
    EXPECT_NEAR(body->area() / area, 1, 0.25);
    if (b.area > 0) EXPECT_NEAR(area / b.area, 1, 0.01);
    if (b.volume > 0) EXPECT_NEAR(volume / b.volume, 1, 0.03);
    EXPECT_LT(length(normals), 0.03 * area)
        << "what is closed has as much on each side; of sheets both count";
  }
}

TEST(BodyLamp, OnlyShapesOfFewCrossingsAreKnown) {
  const auto known = [](const Shape& shape) { return Lamps::canSample(worldOf(shape, Affine{}), 0); };
  EXPECT_TRUE(known(Square{}));
  EXPECT_FALSE(known(Plane{}));
  EXPECT_FALSE(known(Mandelbulb{}));
  EXPECT_FALSE(BodyLamp::of(worldOf(Torus{}, Affine::scaling({1, 1, 0})), 0)) << "of no width";
}

Settings settingsOf(IntegratorKind kind, int spp) {
  Settings settings;
  settings.integrator = kind;
  settings.sampling = SampleKind::random;
  settings.width = settings.height = 12;
  settings.depth = 3, settings.spp = spp;
  settings.airIndex = 1;
  settings.chainStarts = 2000;
  settings.photons = 40000;
  settings.lampSamples = 1;
  return settings;
}

/// It hangs in the open room.
Scene litBy(const Body& body) {
  Scene scene = openRoom();
  addObject(scene, body.shape, Affine::translation({0.2, 0.1, 0}) * body.place, diffuse(0, 3));
  return scene;
}

/// `bias`: by which part of its light a tile may differ.
void expectTheSameLight(const Body& body, const Settings& a, const Settings& b, double bias = 0) {
  SCOPED_TRACE(body.name);
  const Agreement found = agreement(litBy(body), a, b, 6, 6, bias);
  EXPECT_NEAR(found.meanA, found.meanB, 4 * found.error + 0.2 * bias * found.meanA);
  EXPECT_LT(found.error, 0.06 * found.meanA) << "or nothing is shown";
  EXPECT_GT(found.least, 1e-5);
}

TEST(BodyLamp, BdptShowsTheLightOfPaths) {
  for (const Body& body : bodies())
    expectTheSameLight(body, settingsOf(IntegratorKind::path, 64), settingsOf(IntegratorKind::bdpt, 64));
}

TEST(BodyLamp, PhotonsShowTheLightOfPaths) {
  for (const Body& body : bodies())
    expectTheSameLight(body, settingsOf(IntegratorKind::path, 64), settingsOf(IntegratorKind::photon, 64),
                       0.03);
}

TEST(BodyLamp, ChainsShowTheLightOfPaths) {
  for (const Body& body : bodies()) {
    Settings chains = settingsOf(IntegratorKind::mlt, 160);
    chains.chains = Chains::veach;
    expectTheSameLight(body, settingsOf(IntegratorKind::path, 64), chains);
  }
}

/// A small patch of a floor below the body.
TEST(BodyLamp, WhittedShowsTheLightOfDirect) {
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    Scene scene;
    addObject(scene, Square{}, turned({1, 0, 0}, -0.5) * Affine::scaling({0.02, 0.02, 1}), diffuse(1));
    addObject(scene, body.shape, Affine::translation({0, 1.2, 0}) * body.place, diffuse(0, 1));
    scene.camera.position = {3, 1, 0}, scene.camera.viewdir = {-3, -1, 0};
    scene.camera.fov = 0.02;
    const auto found = [&](IntegratorKind kind, int spp) {
      Settings settings = settingsOf(kind, spp);
      settings.sampling = SampleKind::sobol;
      settings.width = settings.height = 4;
      settings.lampSamples = kind == IntegratorKind::whitted ? 16 : 0;
      return meanColor(picture(scene, settings)).g;
    };
    EXPECT_NEAR(found(IntegratorKind::whitted, 64) / found(IntegratorKind::direct, 4096), 1, 0.02);
  }
}

TEST(BodyLamp, HasLessNoiseThanWhatIsMetAtRandom) {
  const Body body{"tube", Cylinder{}, Affine::scaling({0.05, 0.05, 1}) * Affine::translation({0, 0, -0.5})};
  const Picture sampled = picture(litBy(body), settingsOf(IntegratorKind::path, 16));
  Settings many = settingsOf(IntegratorKind::path, 4096);
  const Picture truth = picture(litBy(body), many);
  double error = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    error += std::pow(sampled.pixels[i].g - truth.pixels[i].g, 2) / std::pow(truth.pixels[i].g + 0.01, 2);
  EXPECT_LT(error / static_cast<double>(truth.pixels.size()), 0.1);  // some 3 by paths that meet it at random
}

TEST(BodyLamp, TheSameBitsForAnyNumberOfThreadsAndExplained) {
  for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::path}) {
    Scene scene = litBy(bodies()[5]);
    Settings settings = settingsOf(kind, 4);
    const Picture one = sameForAnyThreads(scene, settings);
    const World world = build(scene, settings);
    const auto integrator = integratorOf(world, settings);
    for (int at = 0; at < 12; at += 3) {
      const Explanation e = explain(world, *integrator, settings, {12, 12}, at, at, at % 4);
      EXPECT_EQ(e.pixel, one.at(at, at)) << at;
      EXPECT_TRUE(sumsUp(e.tree)) << at;
    }
  }
}

}  // namespace
}  // namespace trace::test::body_lamp_test
