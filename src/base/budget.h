// How much time a command may take, and how far its work has come.
//
// Any loop whose length the input chooses calls checkBudget(), which looks at the clock now and then, and
// throws once the time is over. What takes long says so by a Work: the message of a limit names it, and
// whoever watches can show it. Memory needs no calls: beyond its limit every allocation fails.
//
// The budget of the calling thread is ambient: a variable of the thread, as the allocator is one of the
// process. It has to reach every loop of every shape, reader and check, and no result depends on it: work
// only ends early. parallelChunks() hands it on to its workers.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace trace {

class Work;

class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  /// Begins now, without a limit. Inside another one that one holds as well.
  explicit Budget(Budget* outer = nullptr) : outer_(outer) {}
  /// Asks `look` as well as the clock. It may throw, which ends the work.
  explicit Budget(std::function<void()> look) : look_(std::move(look)) {}
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  /// Seconds from the start on; 0 for no limit.
  void limitTime(double seconds) { limit_ = seconds; }
  double timeLimit() const { return limit_; }
  double seconds() const;  ///< since the start
  bool timeIsOver() const { return lateOne() != nullptr; }
  /// The finished part is going to be kept: until this is taken back nobody ends the process for being late.
  void letFinish(bool finishes = true) { finishes_ = finishes; }
  bool finishes() const { return finishes_; }

  /// Throws Error(Fault::limit) if the time is over.
  void look() const;

  struct Step {
    const char* doing = "";
    std::int64_t done = 0, total = 0;  ///< total 0: it is not known
    double share = 0;                  ///< with the part of the next one that is done; of outermost() only
  };
  /// The outermost work that is done now and its start, in seconds(); "" if there is none. From any thread.
  std::pair<Step, double> outermost() const;
  /// The task during which the last exception was thrown, as doingNow().
  std::string brokenOff() const;

 private:
  friend class Work;
  static constexpr std::size_t kMostSteps = 4;

  /// This or the one around whose time is over; null if there is none.
  const Budget* lateOne() const;

  Budget* const outer_ = nullptr;
  const std::function<void()> look_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<double> limit_{0};
  std::atomic<bool> finishes_{false};
  mutable std::mutex mutex_;  // protects the members below
  const Work* outermost_ = nullptr;
  std::array<Step, kMostSteps> broken_{};  // innermost first; no list, since memory may be what is lacking
  std::size_t brokenCount_ = 0;
};

/// The budget and tasks of a thread.
struct BudgetOfThread {
  Budget* budget = nullptr;
  const Work* work = nullptr;  ///< the innermost
  int untilLook = 0;
};
inline constinit thread_local BudgetOfThread budgetOfThread;

/// Makes the budget that of this thread, for as long as the scope lives; null for none.
class BudgetScope {
 public:
  explicit BudgetScope(Budget* budget) : BudgetScope(BudgetOfThread{budget, nullptr, 0}) {}
  explicit BudgetScope(const BudgetOfThread& given) : before_(budgetOfThread) { budgetOfThread = given; }
  ~BudgetScope() { budgetOfThread = before_; }
  BudgetScope(const BudgetScope&) = delete;
  BudgetScope& operator=(const BudgetScope&) = delete;

 private:
  const BudgetOfThread before_;
};

/// Looks at the budget of this thread at once.
void lookAtBudget();

/// Looks in one of many calls: for the inside of loops, whose rounds are short.
inline void checkBudget() {
  if (--budgetOfThread.untilLook < 0) lookAtBudget();
}

/// A piece of work that may take long, for as long as it lives.
class Work {
 public:
  /// `doing`, a literal, follows on "while": "reading the scene".
  explicit Work(const char* doing, std::int64_t total = 0);
  ~Work();
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  /// Says how far it is, and looks at the budget.
  void reached(std::int64_t done) {
    done_ = done;
    lookAtBudget();
  }

 private:
  friend class Budget;
  friend std::string doingNow();
  Budget::Step step() const { return {doing_, done_, total_}; }
  /// 0 to 1. The budget's mutex is held.
  double share() const;

  const char* const doing_;
  const std::int64_t total_;
  std::atomic<std::int64_t> done_{0};
  Budget* const budget_;
  const Work* const outer_;
  mutable const Work* inner_ = nullptr;  ///< that began last; the budget's mutex guards it
  const double since_;
  const int exceptions_;
};

/// The tasks of this thread, outermost first, and their progress: "building the objects (3 of 10), laying out
/// copies"; "" if nobody said.
std::string doingNow();

}  // namespace trace
