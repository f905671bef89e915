// Colours that stand for numbers can be told apart.
#include "image/comparison/false_color.h"

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

TEST(HeatColor, GrowsBrighterFromBlackToWhite) {
  EXPECT_EQ(heatColor(0), Color(0));
  EXPECT_EQ(heatColor(-1), Color(0));
  EXPECT_EQ(heatColor(1), Color(1));
  EXPECT_EQ(heatColor(7), Color(1));
  EXPECT_EQ(heatColor(std::nan("")), Color(1));
  const auto luminance = [](const Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  for (int i = 0; i < 100; ++i)
    EXPECT_LT(luminance(heatColor(i / 100.0)), luminance(heatColor((i + 1) / 100.0))) << i;
}

}  // namespace
}  // namespace trace
