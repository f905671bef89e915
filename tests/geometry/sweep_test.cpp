// Profiles carried along paths, against what is known of them.
#include "geometry/shapes/surfaces/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

const Prism::Outline kSquare{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

Sweep straight(Real length, Real endScale) {
  Sweep sweep;
  sweep.profile = kSquare, sweep.spline = Spline::linear;
  sweep.points = {{0, 0, 0, 1}, {0, 0, length, endScale}};
  return sweep;
}

/// Four Bezier arcs that are nearly a circle around the origin.
template <std::size_t N>
std::vector<std::array<Real, N>> circle(Real radius) {
  const Real k = 0.5522847498, corners[][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  std::vector<std::array<Real, N>> points;
  const auto add = [&](Real x, Real y) {
    std::array<Real, N> p{};
    p[0] = radius * x, p[1] = radius * y;
    if constexpr (N == 4) p[3] = 1;
    points.push_back(p);
  };
  add(1, 0);
  for (int i = 0; i < 4; ++i) {
    const auto &a = corners[i], &b = corners[i + 1];
    add(a[0] + k * b[0], a[1] + k * b[1]), add(b[0] + k * a[0], b[1] + k * a[1]), add(b[0], b[1]);
  }
  return points;
}

Real sweepVolume(const Sweep& sweep, int n) { return volume(sweep, boundsOf(prepare(Shape(sweep))), n); }

TEST(Sweep, HasTheVolumeOfProfileTimesPath) {
  EXPECT_NEAR(sweepVolume(straight(2, 1), 50), 2, 1e-12);
  EXPECT_NEAR(sweepVolume(straight(2, 0), 100), 2.0 / 3, 1e-3);  // a pyramid
  Sweep twisted = straight(2, 1);
  twisted.twist = 180;
  EXPECT_NEAR(sweepVolume(twisted, 80), 2, 3e-3);
  Sweep ring;  // Pappus
  ring.profile = circle<2>(0.25), ring.profileSpline = Spline::bezier, ring.points = circle<4>(1);
  EXPECT_NEAR(sweepVolume(ring, 80), 1.23370, 3e-3);
  ring.twist = 720;
  EXPECT_NEAR(sweepVolume(ring, 80), 1.23370, 3e-3);
  std::reverse(ring.profile.begin(), ring.profile.end());  // either way around
  EXPECT_NEAR(sweepVolume(ring, 80), 1.23370, 3e-3);
}

TEST(SphereSweep, KnowsTheTextureCoordinatesBesideAHit) {
  // What strands are combed by: the direction in which u grows.
  const TracedShape capsule = prepare(SphereSweep{{{0, 0, 0, 0.25}, {0, 0, 1, 0.25}}, Spline::linear});
  const Ray ray{{3, 0, 0.5}, {-1, 0, 0}};
  const auto met = crossingsOf(capsule, ray);
  ASSERT_EQ(met.size(), 2u);
  for (const Real step : {1e-6, 1e-4}) {
    const Ray beside{{3, 0, 0.5 + step}, {-1, 0, 0}};
    EXPECT_NEAR(Vec2(surfaceOf(capsule, beside, met[0]).uv).x, 0.5 + step, 1e-10);
  }
}

/// The distance of a place in the plane from an arc; infinite beside its ends.
Real distanceFrom(const Cubic<4>& arc, Real x, Real y) {
  const auto at = [&](Real u) { return std::hypot(arc.at(0, u) - x, arc.at(1, u) - y); };
  Real best = 0, step = 1.0 / 256;
  for (int i = 0; i <= 256; ++i)
    if (at(i * step) < at(best)) best = i * step;
  for (; step > 1e-10; step /= 2)
    for (const Real u : {best - step, best + step})
      if (u >= 0 && u <= 1 && at(u) < at(best)) best = u;
  return best > 1e-6 && best < 1 - 1e-6 ? at(best) : kInfinity;
}

TEST(Sweep, SidesStayAtTheirDistanceFromThePath) {
  // In a plane the profile's directions are known: across the path, and up. Here it bends unevenly.
  Sweep sweep;
  sweep.points = {{0, 0, 0, 1}, {2, 0, 0, 1}, {2.2, 0.3, 0, 1}, {0.5, 2, 0, 1}};
  sweep.profile = {{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}};
  const Cubic<4> arc = arcsOf<4>(sweep.spline, sweep.points).arcs[0];
  const TracedShape shape = prepare(Shape(sweep));
  const Box3 box = boundsOf(shape);
  Random random(1);
  Real most = 0;
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 d = random.direction(), target = box.center() + random.inCube(1.2);
    for (const Crossing& c : placesOf(shape, {target - d * 5, d})) {
      const SurfacePoint s = surfaceOf(shape, {target - d * 5, d}, c);
      const Real off = std::abs(distanceFrom(arc, s.point.x, s.point.y) - 0.2);
      if (std::abs(s.normal.z) > 0.5 || off == kInfinity) continue;  // above or below, or an end
      ++hits, most = max(most, off);
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LT(most, 1e-6);
}

TEST(Sweep, MitresCornersAndClosesRings) {
  Sweep frame;
  frame.profile = {{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}, frame.spline = Spline::linear;
  frame.points = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}, {-1, -1, 0, 1}};
  const Box3 box = boundsOf(prepare(Shape(frame)));
  EXPECT_NEAR(box.high.x, 1.1, 1e-12);
  EXPECT_NEAR(box.high.z, 0.1, 1e-12);
  EXPECT_TRUE(isSolid(frame));
  // Along the diagonal through two corners.
  const auto c = crossingsOf(frame, {{-3, -3, 0.05}, {1, 1, 0}});
  ASSERT_EQ(c.size(), 4u);
  const Real places[] = {-1.1, -0.9, 0.9, 1.1};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(c[i].t - 3, places[i], 1e-12);
}

TEST(Sweep, IsOneBodyWhereItPassesThroughItself) {
  Sweep cross = straight(4, 1);
  cross.points = {{-2, 0, 0, 0.5}, {2, 0, 0, 0.5}, {2, 2, 0, 0.5}, {0, 2, 0, 0.5}, {0, -2, 0, 0.5}};
  const auto c = crossingsOf(cross, {{-3, 0.1, 0.05}, {1, 0, 0}});
  ASSERT_EQ(c.size(), 2u);
  EXPECT_NEAR(c[0].t, 1, 1e-12);
}

TEST(Sweep, RefusesMoreTurnsThanItsPiecesFollow) {
  Sweep sweep;
  sweep.twist = 1e9;
  EXPECT_THROW(prepare(sweep), Error);
  sweep.twist = 3600;
  EXPECT_NO_THROW(prepare(sweep));
}

TEST(Sweep, OpenOnesAreSheets) {
  Sweep sweep;
  sweep.capped = false;
  EXPECT_FALSE(isSolid(sweep));
  sweep.capped = true, sweep.closed = false;
  EXPECT_FALSE(isSolid(sweep));
}

TEST(Sweep, IsEmptyWithoutLength) {
  Sweep sweep;
  sweep.points = {{1, 1, 1, 1}};
  EXPECT_TRUE(boundsOf(prepare(Shape(sweep))).empty());
  sweep.spline = Spline::linear, sweep.points = {{1, 1, 1, 1}, {1, 1, 1, 2}};
  EXPECT_EQ(crossingsOf(sweep, {{0, 1, 1}, {1, 0, 0}}).size(), 0u);
  Sweep profile;
  profile.profile = {};
  EXPECT_TRUE(boundsOf(prepare(Shape(profile))).empty());
}

}  // namespace
}  // namespace trace::test
