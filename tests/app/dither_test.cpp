// Noise against bands of one shade.
#include "app/view/screen/dither.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trace::test {
namespace {

/// The longest run of pixels with one level, in a row whose shade rises by so much for each pixel.
int longestRun(double slope, int row, bool dithered) {
  int run = 0, longest = 0;
  double last = -1;
  for (int x = 0; x < 400; ++x) {
    const double level = std::round(50 + slope * x + (dithered ? ditherAt(x, row, 0) : 0));
    run = level == last ? run + 1 : 1;
    last = level;
    longest = std::max(longest, run);
  }
  return longest;
}

TEST(Dither, LeavesNoBands) {
  constexpr double kSlope = 0.02;  // of a floor that is seen from far away
  EXPECT_GE(longestRun(kSlope, 0, false), 49);
  for (int row = 0; row < 100; ++row) EXPECT_LT(longestRun(kSlope, row, true), 35) << row;
}

TEST(Dither, ChangesNoShadeOnTheAverage) {
  for (int step = 0; step < 8; ++step) {
    double sum = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const double noise = ditherAt(x, y, step);
        EXPECT_LE(std::abs(noise), 0.5);
        sum += noise;
      }
    EXPECT_NEAR(sum / (64 * 64), 0, 0.01) << step;
  }
}

}  // namespace
}  // namespace trace::test
