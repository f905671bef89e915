#include "cli/progress.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/remaining_time.h"
#include "cli/console.h"
#include "cli/flags.h"
#include "scene/options.h"

namespace trace::cli {
namespace {

std::string printed(ProgressStyle style, double seconds, int steps, int columns = 70) {
  std::string text;
  Progress progress(style, columns, [&](const std::string& part) { text += part; });
  for (int i = 0; i <= steps; ++i) progress.update(i, steps, seconds * i / steps);
  progress.finish(steps, steps, seconds);
  return text;
}

size_t lines(const std::string& text) {
  return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
}

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

TEST(RemainingTime, NeverNegative) {
  RemainingTime estimate;
  estimate.update(1, 0.5);
  EXPECT_GE(*estimate.update(50, 0.99), 0);
  EXPECT_EQ(estimate.update(60, 1), 0);
}

TEST(Progress, PlainPrintsEveryTenth) {
  EXPECT_EQ(lines(printed(ProgressStyle::plain, 60, 600)), 9u);
  EXPECT_EQ(lines(printed(ProgressStyle::plain, 600, 6000)), 59u);  // every 10 s
  EXPECT_EQ(printed(ProgressStyle::plain, 0.9, 100), "");
  EXPECT_EQ(printed(ProgressStyle::none, 600, 6000), "");
}

TEST(Progress, BarFitsAnyTerminal) {
  for (int columns : {1, 5, 20, 60, 300}) {
    const std::string text = printed(ProgressStyle::bar, 100, 1000, columns);
    for (size_t at = 0; (at = text.find('\r', at)) != std::string::npos; ++at)
      EXPECT_LE(text.find('\033', at) - at - 1, static_cast<size_t>(std::max(1, columns - 1)));
    EXPECT_EQ(text.substr(text.size() - 4), "\r\033[K");
  }
}

TEST(Progress, JsonEndsWithAll) {
  const std::string text = printed(ProgressStyle::json, 0.5, 5);
  EXPECT_NE(text.find("{\"done\":0,\"total\":5,\"fraction\":0,\"elapsed\":0,\"remaining\":null}\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("{\"done\":5,\"total\":5,\"fraction\":1,\"elapsed\":0.5,\"remaining\":0}\n"),
            std::string::npos)
      << text;
}

TEST(DurationText, Sizes) {
  EXPECT_EQ(durationText(0.042), "0.04 s");
  EXPECT_EQ(durationText(3.21), "3.2 s");
  EXPECT_EQ(durationText(59.4), "59 s");
  EXPECT_EQ(durationText(125), "2 min 05 s");
  EXPECT_EQ(durationText(3780), "1 h 03 min");
}

TEST(Enable, EveryExtraHasAValueThatDiffersFromItsDefault) {
  for (const Option& option : options()) {
    if (!option.extra) continue;
    Settings settings;
    ASSERT_FALSE(enabledValue(option).empty()) << option.name;
    option.assign(settings, enabledValue(option));
    EXPECT_NE(option.get(settings), option.get(Settings{})) << option.name;
  }
}

}  // namespace
}  // namespace trace::cli
