// Strands, against what is known of tubes and ribbons.
#include "geometry/shapes/surfaces/curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

/// A line along z of that width.
Curves straightStrand(Real width, bool round) {
  Curves curves;
  curves.strands = {{{0, 0, 0, width}, {0, 0, 2, width}}};
  curves.spline = Spline::linear, curves.round = round;
  return curves;
}

/// Strands that bend gently, as hair does.
Curves hairs(int count, bool round, Random& random) {
  Curves curves;
  curves.strands.clear();
  curves.round = round;
  for (int i = 0; i < count; ++i) {
    Curves::Strand strand;
    Vec3 p = random.inCube(1), d = random.direction();
    for (int k = 0; k < 7; ++k) {
      strand.push_back({p.x, p.y, p.z, 0.04 - 0.005 * k});
      d = normalize(d + random.inCube(0.6));
      p += d * 0.1;
    }
    curves.strands.push_back(strand);
  }
  return curves;
}

std::vector<std::array<Real, 4>> withRadii(Curves::Strand strand) {
  for (auto& point : strand) point[3] /= 2;
  return strand;
}

Ray rayThrough(Random& random) {
  const Vec3 d = random.direction();
  return {random.inCube(1) - d * 5, d};
}

TEST(Curves, TubesAreCylindersWithRoundEnds) {
  const Curves tube = straightStrand(0.5, true);
  const Ray across{{3, 0.2, 1}, {-1, 0, 0}};
  const auto met = crossingsOf(tube, across);
  ASSERT_EQ(met.size(), 1u) << "where the ray enters";
  EXPECT_NEAR(met[0].t, 3 - std::sqrt(0.25 * 0.25 - 0.2 * 0.2), 1e-14);
  const SurfacePoint s = surfaceOf(tube, across, met[0]);
  EXPECT_NEAR(s.normal.y, 0.8, 1e-14);
  EXPECT_NEAR(Vec2(s.uv).x, 0.5, 1e-12);
  const auto end = crossingsOf(tube, Ray{{0, 0, 5}, {0, 0, -1}});
  ASSERT_EQ(end.size(), 1u);
  EXPECT_NEAR(end[0].t, 2.75, 1e-14);
}

TEST(Curves, RibbonsFaceTheRay) {
  const Curves ribbon = straightStrand(0.5, false);
  for (const Real turn : {0.0, 1.0, 2.5}) {
    const Vec3 d{std::cos(turn), std::sin(turn), 0.3}, side = normalize(cross(d, {0, 0, 1}));
    for (const Real offset : {-0.24, 0.0, 0.2}) {
      const Ray ray{Vec3{0, 0, 1} + side * offset - d * 3, d};
      const auto met = crossingsOf(ribbon, ray);
      ASSERT_EQ(met.size(), 1u);
      EXPECT_NEAR(met[0].t, 3, 1e-12) << "in the plane of the curve";
      const SurfacePoint s = surfaceOf(ribbon, ray, met[0]);
      EXPECT_NEAR(std::abs(Vec2(s.uv).y - 0.5), std::abs(offset) / 0.5, 1e-12) << "v goes across";
      EXPECT_NEAR(s.normal.z, 0, 1e-12);
    }
    EXPECT_TRUE(crossingsOf(ribbon, Ray{Vec3{0, 0, 1} + side * 0.26 - d * 3, d}).empty());
  }
}

TEST(Curves, TubesAreEnteredWhereSweptSpheresAre) {
  Random random(1);
  const Curves curves = hairs(40, true, random);
  std::vector<TracedShape> sweeps;
  for (const Curves::Strand& strand : curves.strands)
    sweeps.push_back(prepare(SphereSweep{withRadii(strand), Spline::bezier}));
  const TracedShape all = prepare(curves);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Ray ray = rayThrough(random);
    Real nearest = kInfinity;
    for (const TracedShape& sweep : sweeps)
      for (const Crossing& c : crossingsOf(sweep, ray)) nearest = min(nearest, c.t);
    const auto met = crossingsOf(all, ray);
    ASSERT_EQ(met.empty(), nearest == kInfinity) << i;
    if (met.empty()) continue;
    ++hits;
    EXPECT_NEAR(met[0].t, nearest, 1e-6) << "the points are float";
  }
  EXPECT_GT(hits, 300);
}

TEST(Curves, GiveTheNearestFirstWhereOnlyThatIsWanted) {
  Random random(2);
  for (const bool round : {true, false}) {
    const TracedShape all = prepare(hairs(300, round, random));
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = rayThrough(random);
      Real nearest = kInfinity;
      const auto closer = [&](const Crossing& c) {
        if (c.t > 0 && c.t < nearest) nearest = c.t;
      };
      all.crossings(ray, Range{0, nearest}, closer);
      const auto met = crossingsOf(all, ray);
      EXPECT_EQ(nearest, met.empty() ? kInfinity : met[0].t);
    }
  }
}

TEST(Curves, ARayThatStartsOnAStrandLeavesIt) {
  Random random(3);
  for (const bool round : {true, false}) {
    Curves one = hairs(1, round, random);
    for (auto& point : one.strands[0]) point[3] = 0.02;
    const TracedShape strand = prepare(one);
    const Box3 box = boundsOf(strand);
    int again = 0, hits = 0;
    for (int i = 0; i < 40'000 && hits < 500; ++i) {
      const Vec3 d = random.direction();
      const Ray ray{box.center() + random.inCube(maxComponent(box.size()) / 2) - d * 5, d};
      const auto met = crossingsOf(strand, ray);
      if (met.empty()) continue;
      ++hits;
      const SurfacePoint s = surfaceOf(strand, ray, met[0]);
      const Vec3 out = random.direction();
      for (const Crossing& c : crossingsOf(strand, spawnRay(s, out))) again += c.t > 0 && c.t < 0.05;
    }
    EXPECT_GT(hits, 100);
    EXPECT_LE(again, hits / 100) << "through itself, in any direction";
  }
}

TEST(Curves, StrandsOfTooFewPointsAreLeftOut) {
  Curves curves = straightStrand(0.5, true);
  curves.strands.push_back({{5, 0, 0, 1}});
  curves.strands.push_back({});
  EXPECT_LT(boundsOf(prepare(curves)).high.x, 1);
  curves.strands = {{{0, 0, 0, 1e300}, {0, 0, 1e300, 1}}};
  EXPECT_TRUE(boundsOf(prepare(curves)).empty()) << "beyond float";
}

}  // namespace
}  // namespace trace::test
