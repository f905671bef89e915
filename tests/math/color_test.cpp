#include "math/color.h"

#include <gtest/gtest.h>

#include <limits>

namespace trace {
namespace {

TEST(Color, CalculatesByChannel) {
  const Color a{1, 2, 4}, b{0.5, 0.25, 2};
  EXPECT_EQ(a + b, Color(1.5, 2.25, 6));
  EXPECT_EQ(a * b, Color(0.5, 0.5, 8));
  EXPECT_EQ(2 * a, a + a);
  EXPECT_EQ(a / 2, a * 0.5);
  EXPECT_EQ(pow(a, 2), Color(1, 4, 16));
  EXPECT_EQ(pow(a, 0), Color(1));
  EXPECT_EQ(lerp(0.25, Color(0), Color(4)), Color(1));
  EXPECT_EQ(maxComponent(Color(1, 3, 2)), 3);
}

TEST(Color, IsClampedToWhatAScreenShows) { EXPECT_EQ(clamp01({-1, 0.5, 7}), Color(0, 0.5, 1)); }

TEST(Color, OnlyZeroIsBlack) {
  EXPECT_TRUE(isBlack({}));
  EXPECT_TRUE(isBlack({0, -0.0, 0}));
  EXPECT_FALSE(isBlack({0, 0, 1e-300}));
}

TEST(Color, IsFiniteInEveryChannel) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(isFinite(Color(1e308, 0, -1e308)));
  EXPECT_FALSE(isFinite(Color(0, kInfinite, 0)));
  EXPECT_FALSE(isFinite(Color(0, 0, std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace trace
