// Particle systems against what mechanics says.
#include "scene/particles.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace trace {
namespace {

/// One particle, thrown at time 0, without chance.
Particles single() {
  Particles p;
  p.rate = 1, p.duration = 0.5, p.lifetime = 10, p.lifetimeSpread = 0, p.spread = {}, p.velocitySpread = 0;
  p.velocity = {1, 0, 5}, p.step = 0.001;
  return p;
}

TEST(Particles, FallAsStonesDo) {
  const auto all = particlesAt(single(), 0.8);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].place.x, 0.8, 1e-12);
  EXPECT_NEAR(all[0].place.z, 5 * 0.8 - 9.81 * 0.8 * 0.8 / 2, 0.01);
  EXPECT_NEAR(all[0].age, 0.08, 1e-15);
}

TEST(Particles, AreSlowedByTheAirToTheWind) {
  Particles p = single();
  p.gravity = {}, p.drag = 3, p.wind = {-2, 0, 0};
  const Vec3 a = particlesAt(p, 8)[0].place, b = particlesAt(p, 9)[0].place;
  EXPECT_NEAR(b.x - a.x, -2, 1e-6);
  EXPECT_NEAR(b.z - a.z, 0, 1e-6);
  EXPECT_NEAR(b.z, 5.0 / 3, 0.01);  // v / drag
}

TEST(Particles, BounceFromPlanesAndSpheres) {
  Particles p = single();
  p.velocity = {0, 0, 0}, p.position = {0, 0, 1}, p.bounce = 1, p.friction = 0;
  p.planes = {{0, 0, 2, 0}};  // of any length
  for (const Real time : {0.5, 1.0, 1.7, 2.4}) {
    const Real z = particlesAt(p, time)[0].place.z;
    EXPECT_GE(z, 0);
    EXPECT_LE(z, 1.02);
  }
  p.planes = {}, p.spheres = {{0, 0, -1, 1}};
  EXPECT_GE(particlesAt(p, 2)[0].place.z, 0);
  p.bounce = 0;
  EXPECT_NEAR(particlesAt(p, 5)[0].place.z, 0, 1e-3);
}

TEST(Particles, LiveAsLongAsTheyShould) {
  Particles p;
  EXPECT_TRUE(particlesAt(p, -0.1).empty());
  EXPECT_EQ(particlesAt(p, 1).size(), 51u);
  p.lifetimeSpread = 0;
  EXPECT_EQ(particlesAt(p, 100.001).size(), 100u);  // 2 seconds of 50
  p.duration = 1;
  EXPECT_TRUE(particlesAt(p, 3.1).empty());
  p.duration = kNoLimit, p.rate = 1e9;
  EXPECT_THROW(particlesAt(p, 10), Error);
}

TEST(Particles, AreAFunctionOfSeedAndTime) {
  Particles p;
  const auto a = particlesAt(p, 1.5), b = particlesAt(p, 1.5);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].place, b[i].place);
  p.seed = 2;
  EXPECT_NE(particlesAt(p, 1.5)[0].place, a[0].place);
}

}  // namespace
}  // namespace trace
