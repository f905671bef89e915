// Statistics of differences worked out by hand, and the cases without a number.
#include "image/comparison/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trace {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Compare, EqualLevels) {
  const Bytes a{1, 1, {1, 2, 3}};
  const Comparison c = compare(a, a);
  EXPECT_TRUE(c.sameSize);
  EXPECT_TRUE(c.identical);
  EXPECT_EQ(c.maxDifference, 0);
  EXPECT_EQ(c.rmse, 0);
  EXPECT_EQ(c.psnr, kEndless);
  EXPECT_EQ(c.valuesBeyond, 0u);
  EXPECT_EQ(c.fractionBeyond, 0);
}

TEST(Compare, LevelsByHand) {
  const Bytes a{2, 1, {10, 20, 30, 40, 50, 60}}, b{2, 1, {10, 17, 34, 40, 50, 60}};
  const Comparison c = compare(a, b, 3);
  EXPECT_FALSE(c.identical);
  EXPECT_EQ(c.maxDifference, 4);
  EXPECT_DOUBLE_EQ(c.mean, 7.0 / 6);
  EXPECT_DOUBLE_EQ(c.rmse, std::sqrt(25.0 / 6));
  EXPECT_DOUBLE_EQ(c.psnr, 20 * std::log10(255 / std::sqrt(25.0 / 6)));
  EXPECT_EQ(c.valuesBeyond, 1u);  // 3 is not beyond 3
  EXPECT_DOUBLE_EQ(c.fractionBeyond, 1.0 / 6);
  EXPECT_EQ(compare(a, b).valuesBeyond, 2u);
}

TEST(Compare, ColoursByHand) {
  Picture a(1, 1), b(1, 1);
  a.at(0, 0) = {4, 0, 0.5};
  b.at(0, 0) = {1, 0, 0.25};
  const Comparison c = compare(a, b, 1);
  EXPECT_EQ(c.maxDifference, 3);
  EXPECT_DOUBLE_EQ(c.mean, 3.25 / 3);
  EXPECT_DOUBLE_EQ(c.rmse, std::sqrt((9 + 0.0625) / 3));
  EXPECT_EQ(c.valuesBeyond, 1u);
}

TEST(Compare, DifferentSizesAreAsFarAsCanBe) {
  const Comparison c = compare(Picture(2, 3), Picture(3, 2));
  EXPECT_FALSE(c.sameSize);
  EXPECT_FALSE(c.identical);
  EXPECT_EQ(c.maxDifference, kEndless);
  EXPECT_EQ(c.psnr, 0);
}

TEST(Compare, NumbersThatAreNone) {
  Picture a(1, 1), b(1, 1);
  a.at(0, 0) = {kNan, kEndless, -kEndless};
  EXPECT_TRUE(compare(a, a).identical);
  EXPECT_EQ(compare(a, b).maxDifference, kEndless);
  EXPECT_EQ(compare(a, b).valuesBeyond, 3u);
  b.at(0, 0) = {0, kEndless, -kEndless};
  EXPECT_EQ(compare(a, b, 1e9).valuesBeyond, 1u);
}

TEST(Compare, FindsTheWorstPixelAndCountsPixels) {
  const Bytes a{2, 2, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}, b{2, 2, {0, 1, 0, 2, 3, 0, 0, 9, 9, 0, 9, 0}};
  const Comparison c = compare(a, b, 1);
  EXPECT_EQ(c.worstX, 0);
  EXPECT_EQ(c.worstY, 1);
  EXPECT_EQ(c.valuesBeyond, 5u);
  EXPECT_EQ(c.pixelsBeyond, 3u);
  EXPECT_DOUBLE_EQ(c.pixelFractionBeyond, 0.75);
}

}  // namespace
}  // namespace trace
