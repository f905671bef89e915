// FLIP against values worked out by another road: for pictures of one colour the formula by hand (filters do
// nothing to them), for others the filters as two-dimensional sums, in a program of its own.
#include "image/comparison/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/error.h"

namespace trace {
namespace {

Picture plain(const Color& color, int width = 3, int height = 3) {
  Picture picture(width, height);
  for (Color& c : picture.pixels) c = color;
  return picture;
}

double errorOf(const Color& a, const Color& b) { return flipErrors(plain(a), plain(b))[4]; }

TEST(Flip, OfPlainColors) {
  EXPECT_NEAR(errorOf(Color(0), Color(1)), 0.9673797621108888, 1e-7);
  EXPECT_NEAR(errorOf({0, 1, 0}, {0, 0, 1}), 1, 1e-12);  // as far apart as colours can be
  EXPECT_NEAR(errorOf({0.5, 0.5, 0.5}, {0.6, 0.5, 0.5}), 0.24960439870507303, 1e-7);
  EXPECT_NEAR(errorOf({1, 0, 0}, {0, 1, 1}), 0.9799065028076087, 1e-7);
  EXPECT_EQ(errorOf({0.3, 0.2, 0.7}, {0.3, 0.2, 0.7}), 0);
}

TEST(Flip, OfAPatternWithADiskCutOut) {
  constexpr int kWidth = 24, kHeight = 18;
  Picture a(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      a.at(x, y) = {(x * 7 + y * 3) % 32 / 31.0, (x * x + 5 * y) % 29 / 28.0, (x + y * y) % 23 / 22.0};
  Picture b = a;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if ((x - 12) * (x - 12) + (y - 9) * (y - 9) <= 25) b.at(x, y) = {1, 0.5, 0.25};
  const auto at = [&](const std::vector<double>& errors, int x, int y) {
    return errors[static_cast<std::size_t>(y * kWidth + x)];
  };
  const std::vector<double> usual = flipErrors(a, b);
  EXPECT_NEAR(mean(usual), 0.27581120510845525, 1e-9);
  EXPECT_NEAR(at(usual, 12, 9), 0.9151109191601682, 1e-9);
  EXPECT_NEAR(at(usual, 17, 9), 0.6389856838322007, 1e-9);
  EXPECT_NEAR(at(usual, 0, 0), 0.0022953611723653612, 1e-9);
  EXPECT_NEAR(at(usual, 8, 5), 0.4813220330579454, 1e-9);
  const std::vector<double> near = flipErrors(a, b, 20);
  EXPECT_NEAR(mean(near), 0.2198949173803251, 1e-9);
  EXPECT_NEAR(at(near, 17, 9), 0.8781275742353138, 1e-9);
  EXPECT_EQ(at(near, 0, 0), 0);
  EXPECT_NEAR(mean(flipErrors(b, a)), mean(usual), 1e-12);
}

TEST(Flip, OfAPoint) {
  const Picture black = plain(Color(0), 31, 31);
  Picture point = black;
  point.at(15, 15) = Color(1);
  const std::vector<double> errors = flipErrors(black, point);
  EXPECT_NEAR(errors[15 * 31 + 15], 0.8649064759190234, 1e-9);
  EXPECT_NEAR(errors[20 * 31 + 15], 0.0012604440355614955, 1e-9);
  EXPECT_NEAR(mean(errors), 0.014892378480557987, 1e-9);
}

// Tall pictures are worked on in bands, which must not show: rows far from the cut do not know of it.
TEST(Flip, OfAPartIsThatOfTheWholeToTheLastBit) {
  constexpr int kWidth = 9, kHeight = 700, kCut = 130, kReach = 40;
  Picture a(kWidth, kHeight), b(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      a.at(x, y) = {(x * 7 + y * 3) % 32 / 31.0, (x * x + 5 * y) % 29 / 28.0, (x + y * y) % 23 / 22.0};
      b.at(x, y) = {(x * 5 + y * 2) % 32 / 31.0, (x * y) % 29 / 28.0, 0.5};
    }
  const auto below = [](const Picture& whole) {
    Picture part(kWidth, kHeight - kCut);
    std::copy(whole.pixels.begin() + kCut * kWidth, whole.pixels.end(), part.pixels.begin());
    return part;
  };
  const std::vector<double> whole = flipErrors(a, b), part = flipErrors(below(a), below(b));
  ASSERT_EQ(whole.size(), std::size_t{kWidth * kHeight});
  ASSERT_EQ(part.size(), std::size_t{kWidth * (kHeight - kCut)});
  for (int i = kReach * kWidth; i < kWidth * (kHeight - kCut); ++i)
    ASSERT_EQ(part[static_cast<std::size_t>(i)], whole[static_cast<std::size_t>(i + kCut * kWidth)]) << i;
}

TEST(Flip, TakesValuesAsAScreenDoes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(errorOf({-1, 2, kInfinity}, {0, 1, 1}), 0);
  EXPECT_EQ(errorOf({std::numeric_limits<double>::quiet_NaN(), 0, 0}, Color(0)), 0);
}

TEST(Flip, SizesMustAgree) {
  EXPECT_THROW(flipErrors(Picture(2, 1), Picture(1, 2)), Error);
  EXPECT_TRUE(flipErrors(Picture(), Picture()).empty());
  EXPECT_EQ(mean({}), 0);
}

}  // namespace
}  // namespace trace
