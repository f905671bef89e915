#include "cli/terminal/progress.h"

#include <gtest/gtest.h>

#include "cli/flags.h"
#include "cli/terminal/console.h"
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
