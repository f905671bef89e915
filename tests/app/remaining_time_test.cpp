#include "app/session/remaining_time.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trace::test {
namespace {

TEST(RemainingTime, SteadyWorkIsEstimatedExactly) {
  RemainingTime estimate;
  EXPECT_FALSE(estimate.update(1, 0.01));
  for (int i = 3; i <= 100; ++i) {
    const auto left = estimate.update(i, i / 100.0);
    ASSERT_TRUE(left);
    EXPECT_NEAR(*left, 100 - i, 1e-9);
  }
}

TEST(RemainingTime, AJumpIsSmoothed) {
  RemainingTime estimate;
  for (int i = 1; i <= 40; ++i) estimate.update(0.1 * i, 0.01 * i);  // 10 s in all, 6 left
  const auto left = estimate.update(4.1, 0.8);                       // 5.1 s in all
  ASSERT_TRUE(left);
  EXPECT_GT(*left, 5);
  EXPECT_LT(*left, 6);
}

TEST(RemainingTime, WorkThatSlowsDownIsNotSaidToBeDone) {
  RemainingTime estimate;
  for (int i = 1; i < 200; ++i) {  // 20 s; the share grows as the square root of time
    const double elapsed = 0.1 * i, fraction = std::sqrt(elapsed / 20);
    const auto left = estimate.update(elapsed, fraction);
    ASSERT_TRUE(left);
    EXPECT_GE(*left, 0.5 * (elapsed / fraction - elapsed) - 1e-9);
  }
}

TEST(RemainingTime, AMachineThatGetsBusyIsNoticed) {
  // 1 % a second for 20 s, then other programs take three quarters of the machine.
  RemainingTime estimate;
  const auto fraction = [](double t) { return t < 20 ? 0.01 * t : 0.2 + 0.0025 * (t - 20); };
  for (int i = 1; i <= 400; ++i) {
    const double elapsed = 0.1 * i;
    const auto left = estimate.update(elapsed, fraction(elapsed));
    if (i < 400) continue;
    ASSERT_TRUE(left);  // 25 % are done, 300 s are left; the mean rate says 120
    EXPECT_GT(*left, 240);
    EXPECT_LT(*left, 330);
  }
}

TEST(RemainingTime, WorkThatWaitsForItsNextPieceIsNotSaidToTakeHours) {
  // Eight pieces of 4 s, 32 s in all.
  RemainingTime estimate;
  for (int i = 1; i < 320; ++i) {
    const double elapsed = 0.1 * i;
    const auto left = estimate.update(elapsed, std::floor(elapsed / 4) / 8);
    if (left) {
      EXPECT_LT(*left, 2 * (32 - elapsed) + 8) << elapsed;
    }
  }
}

TEST(RemainingTime, WorkThatComesInLargePiecesIsNotPromisedTooSoon) {
  // On a busy machine a wave of tiles is finished every 5 s; 200 s in all.
  RemainingTime estimate;
  for (int i = 1; i < 1900; ++i) {
    const double elapsed = 0.1 * i, fraction = std::floor(elapsed / 5) * 5 / 200;
    const auto left = estimate.update(elapsed, fraction);
    if (elapsed > 20) {
      EXPECT_GT(*left, 0.8 * (200 - elapsed) - 5) << elapsed;
    }
  }
}

TEST(RemainingTime, NeverNegative) {
  RemainingTime estimate;
  estimate.update(1, 0.5);
  EXPECT_GE(*estimate.update(50, 0.99), 0);
  EXPECT_EQ(estimate.update(60, 1), 0);
}

TEST(DurationText, SuitsPeople) {
  EXPECT_EQ(durationText(0.042), "0.04 s");
  EXPECT_EQ(durationText(0.42), "0.42 s");
  EXPECT_EQ(durationText(3.21), "3.2 s");
  EXPECT_EQ(durationText(59.4), "59 s");
  EXPECT_EQ(durationText(59.7), "1 min 00 s");
  EXPECT_EQ(durationText(125), "2 min 05 s");
  EXPECT_EQ(durationText(3780), "1 h 03 min");
}

}  // namespace
}  // namespace trace::test
