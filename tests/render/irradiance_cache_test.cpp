// The irradiance cache: its gradients against closed forms, what it blends, and pictures with it.
#include "render/maps/irradiance_cache.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "render/picture/explain.h"
#include "support/quarters.h"
#include "support/random.h"
#include "support/rooms.h"

namespace trace::test::irradiance_cache_test {
namespace {

/// The record at the origin of a plane whose normal is z, of what `see` tells of directions.
template <class See>
IrradianceRecord recordOf(int rays, const See& see) {
  Random random(3);
  const HemisphereCells cells(rays);
  std::vector<HemisphereCells::Seen> seen;
  for (int n = 0; n < cells.count(); ++n)
    seen.push_back(see(cells.direction(n, {random.uniform(), random.uniform()})));
  return cells.record({}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, seen);
}

TEST(IrradianceCache, EvenLightHasNoGradients) {
  for (const int rays : {4, 16, 100, 400}) {
    const IrradianceRecord record = recordOf(rays, [](const Vec3&) {
      return HemisphereCells::Seen{{1, 2, 3}, 5};
    });
    EXPECT_NEAR(record.light.b, 3, 1e-12);
    EXPECT_NEAR(record.distance, 5, 1e-12);
    EXPECT_NEAR(length(record.moving.b), 0, 1e-12);
    EXPECT_NEAR(length(record.turning.b), 0, 0.05);
  }
}

TEST(IrradianceCache, KnowsHowLightChangesWithTheNormal) {
  // A sky of radiance 1 + w.d lights a surface by 1 + 2/3 w.n.
  const Vec3 w{0.3, -0.5, 0.4};
  const IrradianceRecord record = recordOf(6400, [&](const Vec3& d) {
    return HemisphereCells::Seen{Color(1 + dot(w, d)), kInfinity};
  });
  EXPECT_NEAR(record.light.g, 1 + 2.0 / 3 * w.z, 0.002);
  EXPECT_EQ(length(record.moving.g), 0);
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
    const Vec3 change = cross(axis, Vec3{0, 0, 1});
    EXPECT_NEAR(record.turning.along(axis).g, 2.0 / 3 * dot(w, change), 0.01);
  }
}

TEST(IrradianceCache, KnowsHowLightChangesWithThePlace) {
  // A ceiling at height 2 whose radiance grows along x lights the floor by what shines straight above it.
  const Real slope = 0.2, height = 2;
  const IrradianceRecord record = recordOf(6400, [&](const Vec3& d) {
    const Real t = height / d.z;
    return HemisphereCells::Seen{Color(5 + slope * t * d.x), t};
  });
  EXPECT_NEAR(record.light.g, 5, 0.05);
  EXPECT_NEAR(record.moving.along({1, 0, 0}).g, slope, 0.1 * slope);
  EXPECT_NEAR(record.moving.along({0, 1, 0}).g, 0, 0.1 * slope);
  EXPECT_NEAR(record.moving.along({0, 0, 1}).g, 0, 1e-12);
}

TEST(IrradianceCache, BlendsBetweenItsPlaces) {
  Box3 box;
  box.extend(Vec3{-5, -5, -5});
  box.extend(Vec3{5, 5, 5});
  IrradianceCache cache(box, 0.3);
  IrradianceRecord record{{0, 0, 0}, {0, 0, 1}, Color(2), {}, {}, 2};
  record.moving.add({1, 0, 0}, Color(0.5));
  cache.add(record);
  EXPECT_EQ(cache.at({0, 0, 0}, {0, 0, 1})->light.g, 2);
  EXPECT_NEAR(cache.at({0.1, 0.2, 0}, {0, 0, 1})->light.g, 2.05, 1e-12) << "by its gradient";
  EXPECT_FALSE(cache.at({0.61, 0, 0}, {0, 0, 1})) << "0.3 times its distance is 0.6";
  EXPECT_FALSE(cache.at({0, 0, 0}, normalize(Vec3{0, 1, 2})));
  EXPECT_FALSE(cache.at({0, 0, -0.1}, {0, 0, 1})) << "the record lies before the place";
  record.point = {0.5, 0, 0};
  record.light = Color(2.25);
  cache.add(record);
  for (const Real x : {0.0, 0.1, 0.3, 0.5}) {
    const auto blend = cache.at({x, 0, 0}, {0, 0, 1});
    EXPECT_NEAR(blend->light.g, 2 + 0.5 * x, 1e-9) << "both tell the same";
    EXPECT_EQ(blend->records, 2u);
  }
}

/// A room with a lamp and a mirror.
Scene room() {
  Scene scene = openRoom();
  addObject(scene, Square{},
            Affine::translation({0, 0.98, 0}) * Affine::rotation({1, 0, 0}, kPi / 2) *
                Affine::scaling({0.6, 0.6, 1}),
            diffuse(Color(0.5), 6));
  Phong mirror;
  mirror.reflective = Color(0.9);
  addObject(scene, Sphere{}, Affine::translation({0.3, -0.6, 0}) * Affine::scaling({0.4, 0.4, 0.4}), mirror);
  return scene;
}

Settings cached(int width, int spp) {
  Settings settings;
  settings.integrator = IntegratorKind::photon;
  settings.sampling = SampleKind::sobol;
  settings.width = settings.height = width;
  settings.spp = spp;
  settings.airIndex = 1;
  settings.photons = 100000;
  settings.irradianceCache = 0.2;
  settings.irradianceRays = 256;
  return settings;
}

TEST(IrradianceCache, ShowsARoomAsEveryPlaceByItselfDoes) {
  const Scene scene = room();
  Settings settings = cached(24, 64);
  const auto found = quarters(picture(scene, settings));
  settings.irradianceCache = 0, settings.finalGather = true;
  const auto wanted = quarters(picture(scene, settings));
  for (std::size_t q = 0; q < 4; ++q)
    for (const auto channel : {&Color::r, &Color::g, &Color::b})
      EXPECT_NEAR(found[q].*channel / wanted[q].*channel, 1, 0.03) << q;
}

TEST(IrradianceCache, IsTheSameForAnyNumberOfThreadsAndExplained) {
  const Scene scene = room();
  Settings settings = cached(20, 2);
  settings.photons = 20000, settings.irradianceRays = 64;
  const Picture one = sameForAnyThreads(scene, settings);
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  std::size_t blended = 0;
  for (int at = 0; at < 20; at += 3) {
    const Explanation e = explain(world, *integrator, settings, {20, 20}, at, at, at % 2);
    EXPECT_EQ(e.pixel, one.at(at, at)) << at;
    EXPECT_TRUE(sumsUp(e.tree)) << at;
    for (const RayNode& node : e.tree.nodes)
      for (const Term& term : node.terms) blended += term.cache ? term.cache->records : 0;
  }
  EXPECT_GT(blended, 5u);
}

}  // namespace
}  // namespace trace::test::irradiance_cache_test
