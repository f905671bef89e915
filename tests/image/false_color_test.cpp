// Colours that stand for numbers can be told apart.
#include "image/false_color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trace {
namespace {

TEST(NumberColor, ZeroIsBlackAndTheOthersAreBright) {
  EXPECT_EQ(numberColor(0), Color(0));
  for (std::uint64_t n : {1, 2, 3, 100, 16777216}) {
    EXPECT_GT(maxComponent(numberColor(n)), 0.5) << n;
    EXPECT_LE(maxComponent(numberColor(n)), 1) << n;
  }
}

TEST(NumberColor, AnyTwoOfSixtyDiffer) {
  for (std::uint64_t a = 0; a < 60; ++a)
    for (std::uint64_t b = 0; b < a; ++b) {
      const Color p = numberColor(a), q = numberColor(b);
      EXPECT_GT(std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b), 0.05) << a << " " << b;
    }
}

}  // namespace
}  // namespace trace
