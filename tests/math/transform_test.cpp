#include "math/transform.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace trace::test {
namespace {

void expectNear(const Vec3& a, const Vec3& b, Real error) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], error);
}

TEST(Affine, ARotationIsRightHanded) {
  const Affine quarter = Affine::rotation({0, 0, 1}, kPi / 2);
  expectNear(quarter * Vec3{1, 0, 0}, {0, 1, 0}, 1e-15);
  expectNear(quarter * Vec3{0, 1, 0}, {-1, 0, 0}, 1e-15);
  expectNear(quarter * Vec3{0, 0, 1}, {0, 0, 1}, 1e-15);
}

TEST(Affine, TheRightFactorComesFirst) {
  const Affine m = Affine::translation({1, 2, 3}) * Affine::scaling({2, 4, 8});
  EXPECT_EQ((m * Vec3{1, 1, 1}), (Vec3{3, 6, 11}));
  EXPECT_EQ(linear(m, {1, 1, 1}), (Vec3{2, 4, 8}));
  EXPECT_EQ(determinant(m), 64);
}

TEST(Affine, TheInverseUndoesIt) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Affine m = random.affine(1);
    ASSERT_TRUE(invertible(m));
    const Vec3 p = random.inCube(10);
    expectNear(inverse(m) * (m * p), p, 1e-12);
    expectNear(m * (inverse(m) * p), p, 1e-12);
  }
}

TEST(Affine, ANormalStaysPerpendicular) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Affine m = random.affine(1);
    const Vec3 normal = random.direction(), along = cross(normal, random.direction());
    EXPECT_NEAR(dot(transposed(inverse(m), normal), linear(m, along)), 0, 1e-13);
  }
}

TEST(Affine, WhatIsFlatOrTooLargeHasNoInverse) {
  EXPECT_FALSE(invertible(Affine::scaling({1, 0, 1})));
  EXPECT_FALSE(invertible(Affine::scaling({1e200, 1e200, 1})));
  EXPECT_FALSE(invertible(Affine::scaling({1e-200, 1e-200, 1})));
  EXPECT_FALSE(invertible(Affine::translation({kInfinity, 0, 0})));
  EXPECT_TRUE(invertible(Affine::scaling({1e100, 1e-100, -1})));
}

TEST(Affine, ABoxHoldsTheTransformedPoints) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Affine m = random.affine(1);
    Box3 box;
    box.extend(random.inCube(2)), box.extend(random.inCube(2));
    const Box3 moved = m * box;
    const Vec3 inside{random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
                      random.uniform(box.low.z, box.high.z)};
    Box3 roomy = moved;
    roomy.extend(moved.low - Vec3{1, 1, 1} * 1e-12), roomy.extend(moved.high + Vec3{1, 1, 1} * 1e-12);
    EXPECT_TRUE(roomy.contains(m * inside));
  }
  EXPECT_TRUE((Affine::translation({1, 2, 3}) * Box3{}).empty());
}

}  // namespace
}  // namespace trace::test
