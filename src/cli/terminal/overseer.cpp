#include "cli/terminal/overseer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>

#include "base/error.h"
#include "base/os/process.h"
#include "base/text.h"
#include "cli/terminal/terminal.h"

namespace trace::cli {
namespace {

constexpr std::chrono::milliseconds kLook{100};
constexpr double kGrace = 6;  // seconds after the limit; more than a render's patience

}  // namespace

Overseer::Overseer(const Budget& budget, const Console& console, ProgressStyle style, LateEnd lateEnd)
    : budget_(budget),
      shows_(console.shows(LogLevel::info) && style != ProgressStyle::none && style != ProgressStyle::json),
      draws_(style == ProgressStyle::bar || (style == ProgressStyle::automatic && canRedraw())),
      lateEnd_(lateEnd) {
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    // The system gives no thread: nothing is said of long work.
  }
}

Overseer::~Overseer() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ends_.notify_one();
  if (thread_.joinable()) thread_.join();
  clearDrawnLine();
}

void Overseer::run() {
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, kLook, [this] { return ended_; })) {
    endIfLate();
    if (shows_) report();
  }
}

void Overseer::endIfLate() const {
  const double limit = budget_.timeLimit();
  if (limit <= 0 || budget_.finishes() || budget_.seconds() < limit + kGrace) return;
  const std::string doing = budget_.outermost().first.doing;
  const std::string text =
      "error: the time limit of " + toText(limit) + " s is over" + (doing.empty() ? "" : " while " + doing) +
      "\n" + (lateEnd_.writes ? "nothing written: a limit of size, memory or time was reached\n" : "");
  os::endAtOnce(text, lateEnd_.code);
}

void Overseer::report() {
  const auto [step, since] = budget_.outermost();
  const double now = budget_.seconds();
  if (!*step.doing || now - since < kQuietSeconds) return clearDrawnLine();
  std::string text = step.doing;
  if (since != since_) estimate_ = {}, share_ = 0;
  since_ = since;
  std::optional<double> left;
  if (step.total > 0) {
    share_ = std::max(share_, step.share);  // a step may do several things, one after the other
    left = estimate_.update(now - since, share_);
    text += ": " + std::to_string(static_cast<int>(100 * share_)) + " %";
  }
  text += ", " + durationText(now) + " elapsed" + (left ? ", " + durationText(*left) + " of this left" : "");
  if (draws_) {
    drawOnTerminal(text.substr(0, static_cast<std::size_t>(std::max(1, columns() - 1))));
  } else if (now - std::max(lastPrint_, since) >= kPlainLineSeconds) {
    printToTerminal(text + "\n");
    lastPrint_ = now;
  }
}

}  // namespace trace::cli
