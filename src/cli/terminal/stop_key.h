// Ctrl-C for commands that keep what they have found by then.
#pragma once

#include <atomic>
#include <thread>

#include "base/budget.h"
#include "cli/terminal/console.h"
#include "cli/terminal/terminal.h"

namespace trace::cli {

/// Ctrl-C makes the time of the command be over, so that what is compared by then is kept.
class StopKey {
 public:
  explicit StopKey(const Console& console) : console_(console), budget_(budgetOfThread.budget) {
    signals_.renderingBegins();
    Signals::receive(false);
    thread_ = std::thread([this] { run(); });
  }
  ~StopKey() {
    finished_ = true;
    signals_.wake();
    thread_.join();
    Signals::receive(true);
  }
  StopKey(const StopKey&) = delete;
  StopKey& operator=(const StopKey&) = delete;

  bool pressed() const { return pressed_; }

 private:
  void run() {
    Signals::receive(true);
    while (!finished_) {
      if (signals_.wait(kInterval) != Signals::Event::stop) continue;
      pressed_ = true;
      budget_->letFinish();
      budget_->limitTime(budget_->seconds());
      console_.line(LogLevel::info, "stopping; Ctrl-C again stops at once");
    }
  }

  static constexpr int kInterval = 100;  // milliseconds
  const Console& console_;
  Budget* budget_;
  Signals signals_;
  std::atomic<bool> finished_{false}, pressed_{false};
  std::thread thread_;
};

}  // namespace trace::cli
