// Height fields, terrains and Bezier patches against what is known of them.
#include <gtest/gtest.h>

#include "base/error.h"
#include "geometry/shapes/surfaces/bezier_patches.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "geometry/shapes/surfaces/terrain.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

Ray downward(Random& random) {
  return {{random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), 3},
          {random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), -1}};
}

TEST(HeightField, OfASlopeIsThePlane) {
  Random random(1);
  for (const bool smooth : {false, true}) {
    HeightField field;
    field.formula = "0.25 * x - 0.5 * y", field.points = 10, field.floor = -1;
    field.smooth = smooth;
    const TracedShape shape = prepare(Shape(field));
    const Vec3 normal = normalize({-0.25, 0.5, 1});
    for (int i = 0; i < 1000; ++i) {
      const Ray ray = downward(random);
      const auto c = crossingsOf(shape, ray);
      ASSERT_EQ(c.size(), 2u);
      const SurfacePoint s = surfaceOf(shape, ray, c[0]);
      EXPECT_NEAR(s.point.z, 0.25 * s.point.x - 0.5 * s.point.y, 1e-7);  // heights are kept as floats
      EXPECT_LT(length(s.normal - normal), 1e-5);
    }
  }
}

TEST(HeightField, CellsAreBilinear) {
  auto grid = std::make_shared<HeightGrid>(2, 2);
  grid->at(0, 0) = 0.1f, grid->at(1, 0) = 0.6f, grid->at(0, 1) = -0.2f, grid->at(1, 1) = 0.3f;
  HeightField field;
  field.file = {"x", grid};
  const TracedShape shape = prepare(Shape(field));
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = downward(random);
    const SurfacePoint s = surfaceOf(shape, ray, crossingsOf(shape, ray).at(0));
    const Real u = (s.point.x + 1) / 2, v = (s.point.y + 1) / 2;
    const Real z = (1 - u) * ((1 - v) * 0.1f + v * -0.2f) + u * ((1 - v) * 0.6f + v * 0.3f);
    EXPECT_NEAR(s.point.z, z, 1e-14);
  }
}

/// The finest cells only, one after another: what the blocks must not change.
TEST(HeightField, BlocksLeaveNothingOut) {
  Random random(3);
  HeightField field;
  field.formula = "0.4 * sin(9 * x) * cos(8 * y)", field.points = 40;
  const TracedShape shape = prepare(Shape(field));
  const auto below = [&](const Vec3& p) {  // by a ray straight down, which meets one cell
    const auto c = crossingsOf(shape, {{p.x, p.y, 2}, {0, 0, -1}});
    return p.z < 2 - c.at(0).t;
  };
  for (int i = 0; i < 300; ++i) {
    const Vec3 a{-0.98, random.uniform(-0.98, 0.98), random.uniform(-0.4, 0.4)};
    const Vec3 b{0.98, random.uniform(-0.98, 0.98), random.uniform(-0.4, 0.4)};
    const auto c = crossingsOf(shape, {a, b - a});
    constexpr int kSteps = 200;
    for (int k = 0; k <= kSteps; ++k) {
      const Real t = static_cast<Real>(k) / kSteps;
      bool inside = false, near = false;
      for (const Crossing& crossing : c) {
        inside ^= crossing.t < t;
        near = near || std::abs(crossing.t - t) < 1e-6;
      }
      EXPECT_TRUE(near || inside == below(a + (b - a) * t));
    }
  }
}

TEST(Terrain, IsAFunctionOfItsSeed) {
  const auto heightAt = [](int seed) {
    Terrain terrain;
    terrain.seed = seed, terrain.points = 33;
    return crossingsOf(terrain, {{0.3, 0.2, 3}, {0, 0, -1}}).at(0).t;
  };
  EXPECT_EQ(heightAt(1), heightAt(1));
  EXPECT_NE(heightAt(1), heightAt(2));
}

TEST(BezierPatches, LieWhereTheirPolynomialsSay) {
  const BezierPatches patches;
  const TracedShape shape = prepare(Shape(patches));
  const auto bernstein = [](int i, Real t) {
    const Real s = 1 - t;
    return i == 0 ? s * s * s : i == 1 ? 3 * s * s * t : i == 2 ? 3 * s * t * t : t * t * t;
  };
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Real u = random.uniform(), v = random.uniform();
    Vec3 p;
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const auto& q = patches.patches[0][static_cast<size_t>(4 * j + k)];
        p += Vec3{q[0], q[1], q[2]} * (bernstein(j, v) * bernstein(k, u));
      }
    const Vec3 d = random.direction();
    const Ray ray{p - d * 4, d};
    Real nearest = kInfinity;
    Vec2 uv;
    for (const Crossing& c : crossingsOf(shape, ray))
      if (std::abs(c.t - 4) < nearest) nearest = std::abs(c.t - 4), uv = surfaceOf(shape, ray, c).uv;
    EXPECT_LT(nearest, 1e-6);  // grazing rays lose half of the digits
    EXPECT_NEAR(uv.x, u, 1e-5);
    EXPECT_NEAR(uv.y, v, 1e-5);
  }
}

TEST(BezierPatches, ThatShareAnEdgeLeaveNoGap) {
  BezierPatches both;
  BezierPatches::Points next = both.patches[0];
  for (int j = 0; j < 4; ++j)  // mirrored at its last column
    for (int k = 0; k < 4; ++k) {
      const auto& from = both.patches[0][static_cast<size_t>(4 * j + 3 - k)];
      next[static_cast<size_t>(4 * j + k)] = {2 - from[0], from[1], from[2]};
    }
  both.patches.push_back(next);
  const TracedShape shape = prepare(Shape(both));
  Random random(5);
  for (int i = 0; i < 5000; ++i) {  // aimed at the edge, x = 1
    const Vec3 target{1, random.uniform(-0.9, 0.9), 0}, d{random.uniform(-0.1, 0.1), 0, -1};
    EXPECT_GE(crossingsOf(shape, {target - d * 4, d}).size(), 1u);
  }
}

TEST(BezierPatches, HaveSixteenPoints) {
  BezierPatches patches;
  patches.patches[0].pop_back();
  EXPECT_THROW(patches.prepared(), Error);
}

}  // namespace
}  // namespace trace::test
