#include "app/placing.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(Placing, KeepsTheObjectWhateverIsTyped) {
  const Real infinite = std::numeric_limits<Real>::infinity(), none = std::numeric_limits<Real>::quiet_NaN();
  for (const Real factor : {0.0, infinite, -infinite, none, 1e300, 1e-300})
    EXPECT_EQ(stretched(kPlaced, {factor, 1, 1}), kPlaced) << factor;
}

}  // namespace
}  // namespace trace::test
