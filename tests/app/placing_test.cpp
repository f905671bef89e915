#include "app/editing/placing.h"

#include <gtest/gtest.h>

#include <limits>

#include "shading/cameras/camera.h"

namespace trace::test {
namespace {

void expectNear(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

const Affine kPlaced = Affine::translation({1, 2, 3}) * Affine::scaling({2, 1, 1});

TEST(Placing, TurnsAboutTheObjectsOrigin) {
  const Affine once = turned(kPlaced, {0, 0, 90});
  expectNear(once.offset, {1, 2, 3});
  expectNear(once * Vec3{1, 0, 0}, {1, 4, 3});
  EXPECT_EQ(turned(kPlaced, {}), kPlaced);
}

TEST(Placing, StretchesAlongTheObjectsAxes) {
  expectNear(stretched(kPlaced, {3, 1, 1}) * Vec3{1, 0, 0}, {7, 2, 3});
  expectNear(stretched(kPlaced, {-1, 1, 1}) * Vec3{1, 0, 0}, {-1, 2, 3});
}

TEST(Placing, TakesNoFactorThatLosesTheObject) {
  const Real infinite = std::numeric_limits<Real>::infinity(), none = std::numeric_limits<Real>::quiet_NaN();
  for (const Real factor : {0.0, infinite, -infinite, none, 1e300, 1e-300})
    EXPECT_FALSE(isFactor(factor)) << factor;
  for (const Real factor : {1.0, -2.0, 1e-6, 1e6}) EXPECT_TRUE(isFactor(factor)) << factor;
}

TEST(Placing, TakesNoMatrixThatLosesTheObject) {
  const Real infinite = std::numeric_limits<Real>::infinity(), none = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_TRUE(keepsObject(Affine::scaling({1, 2, 3})));
  for (const Real x : {0.0, infinite, -infinite, none}) {
    Affine typed = kPlaced;
    typed.row[0].x = x;
    EXPECT_FALSE(keepsObject(typed)) << x;
  }
  Affine flat = kPlaced;
  flat.row[1] = flat.row[0];
  EXPECT_FALSE(keepsObject(flat));
  Affine gone = kPlaced;
  gone.offset.x = infinite;
  EXPECT_FALSE(keepsObject(gone));
}

TEST(Placing, TakesNoCameraThatSeesNothing) {
  const auto sees = [](auto&& change) {
    Camera camera;
    change(camera);
    return cameraSees(camera);
  };
  EXPECT_TRUE(sees([](Camera&) {}));
  EXPECT_TRUE(sees([](Camera& c) { c.fov = 0.001; }));
  EXPECT_FALSE(sees([](Camera& c) { c.fov = 0; }));
  EXPECT_FALSE(sees([](Camera& c) { c.fov = 180; }));
  EXPECT_FALSE(sees([](Camera& c) { c.aspectratio = 0; }));
  EXPECT_FALSE(sees([](Camera& c) { c.updir = {}; }));
  EXPECT_FALSE(sees([](Camera& c) { c.viewdir = c.updir; }));
}

}  // namespace
}  // namespace trace::test
