// A thread beside the render: shows progress and obeys signals.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "app/session.h"
#include "cli/arguments.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/terminal.h"

namespace trace::cli {

/// Lives while Session::render() runs. Event::stop cancels the job; Event::save writes the finished tiles to
/// the outputs() of `output`.
class Watch {
 public:
  Watch(Session& session, Signals& signals, const Console& console, ProgressStyle style, std::string output);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  void run();
  void save();
  double elapsed() const;

  Session& session_;
  Signals& signals_;
  const Console& console_;
  const std::string output_;
  Progress progress_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

/// "400x300" or, of a part, "400x300, 37 % done".
std::string pictureText(const Session& session, double fraction);

}  // namespace trace::cli
