// A thread beside a command: says how far long work has come, and ends what does not end in time.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/session/remaining_time.h"
#include "base/budget.h"
#include "cli/terminal/console.h"
#include "cli/terminal/progress.h"

namespace trace::cli {

/// Lives while a command runs. Work that looks at the budget ends by itself when the time is over, and a
/// render keeps what it has. What does neither, such as reading from a pipe that nobody fills, ends the
/// process with a message some seconds later.
class Overseer {
 public:
  /// How the process ends if it has to be ended.
  struct LateEnd {
    int code;     ///< exit code
    bool writes;  ///< says that nothing was written
  };

  Overseer(const Budget& budget, const Console& console, ProgressStyle style, LateEnd lateEnd);
  ~Overseer();
  Overseer(const Overseer&) = delete;
  Overseer& operator=(const Overseer&) = delete;

 private:
  void run();
  void endIfLate() const;
  void report();

  const Budget& budget_;
  const bool shows_, draws_;
  const LateEnd lateEnd_;
  double lastPrint_ = 0;  // seconds of the budget
  double since_ = 0;      // start of the task that estimate_ belongs to
  double share_ = 0;      // finished share of that task
  RemainingTime estimate_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace trace::cli
