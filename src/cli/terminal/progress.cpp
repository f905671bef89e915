#include "cli/terminal/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/session/remaining_time.h"
#include "base/text.h"
#include "cli/terminal/console.h"

namespace trace::cli {
namespace {

constexpr double kJsonInterval = 0.25;

double shareOf(std::int64_t done, std::int64_t total) {
  return total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0;
}

std::string percent(double fraction) {
  char text[16];
  std::snprintf(text, sizeof text, "%3d %%", static_cast<int>(std::floor(100 * fraction)));
  return text;
}

std::string times(double elapsed, const std::optional<double>& remaining) {
  return durationText(elapsed) + " elapsed" + (remaining ? ", " + durationText(*remaining) + " left" : "");
}

/// Without the decimals that a changing number makes unreadable.
std::string seconds(double value) { return toText(std::round(value * 1000) / 1000); }

}  // namespace

Progress::Progress(ProgressStyle style, int columns, Print print)
    : style_(style == ProgressStyle::automatic ? ProgressStyle::plain : style),
      columns_(columns),
      print_(std::move(print)) {}

void Progress::update(std::int64_t done, std::int64_t total, double elapsed, std::optional<double> share) {
  if (total <= 0 || style_ == ProgressStyle::none) return;
  shown_ = std::max(shown_, share.value_or(shareOf(done, total)));
  const double fraction = shown_;
  remaining_ = estimate_.update(elapsed, fraction, before_);
  if (style_ == ProgressStyle::json) {
    if (lastPrint_ < 0 || elapsed - lastPrint_ >= kJsonInterval) json(done, total, elapsed);
    return;
  }
  if (elapsed < kQuietSeconds) return;
  if (style_ == ProgressStyle::bar) {
    const std::string left = percent(fraction) + " [", right = "] " + times(elapsed, remaining_);
    const int width = columns_ - 1 - static_cast<int>(left.size() + right.size());
    std::string text = left;
    if (width > 0) {
      const auto filled = static_cast<size_t>(fraction * width);
      text += std::string(filled, '=') + std::string(static_cast<size_t>(width) - filled, ' ');
    }
    text = (text + right).substr(0, static_cast<size_t>(std::max(1, columns_ - 1)));
    print_("\r" + text + "\033[K");
    drawn_ = true;
    return;
  }
  const int tenth = static_cast<int>(std::floor(10 * fraction));
  if (done >= total || (tenth <= lastTenth_ && elapsed - std::max(0.0, lastPrint_) < kPlainLineSeconds))
    return;
  print_(percent(fraction) + " done, " + times(elapsed, remaining_) + "\n");
  lastPrint_ = elapsed;
  lastTenth_ = tenth;
}

void Progress::clear() {
  if (drawn_) print_("\r\033[K");
  drawn_ = false;
}

void Progress::finish(std::int64_t done, std::int64_t total, double elapsed, std::optional<double> share) {
  clear();
  if (style_ != ProgressStyle::json || total <= 0) return;
  remaining_ = estimate_.update(elapsed, share.value_or(shareOf(done, total)), before_);
  json(done, total, elapsed);
}

void Progress::json(std::int64_t done, std::int64_t total, double elapsed) {
  print_("{\"done\":" + std::to_string(done) + ",\"total\":" + std::to_string(total) +
         ",\"fraction\":" + toText(shareOf(done, total)) + ",\"elapsed\":" + seconds(elapsed) +
         ",\"remaining\":" + (remaining_ ? seconds(*remaining_) : "null") + "}\n");
  lastPrint_ = elapsed;
}

}  // namespace trace::cli
