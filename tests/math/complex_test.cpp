#include "math/complex.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

void expectNear(const Complex& a, const Complex& b) {
  EXPECT_NEAR(a.re, b.re, 1e-14);
  EXPECT_NEAR(a.im, b.im, 1e-14);
}

TEST(Complex, DividesBackWhatItMultiplied) {
  const Complex a{3, -2}, b{0.5, 7};
  expectNear(a * b, {15.5, 20});
  expectNear((a * b) / b, a);
  expectNear(a + b - b, a);
  expectNear(2 * a, {6, -4});
}

TEST(Complex, RootsAreOnTheRight) {
  for (const Complex& a :
       {Complex{3, -4}, Complex{-3, -4}, Complex{-3, 4}, Complex{0, 2}, Complex{-9, 0}, Complex{}}) {
    const Complex root = sqrt(a);
    expectNear(root * root, a);
    EXPECT_GE(root.re, 0);
  }
  expectNear(sqrt(Complex{3, -4}), {2, -1});
  EXPECT_EQ(sqrt(Complex{-9, -0.0}).im, -3);
}

TEST(Complex, HasALengthAndAnAngle) {
  EXPECT_EQ(abs(Complex{3, -4}), 5);
  EXPECT_EQ(arg(Complex{0, -4}), -kPi / 2);
}

}  // namespace
}  // namespace trace
