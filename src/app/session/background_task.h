// A thread for answers that a window must not wait for. Only the newest of several jobs waits: a window asks
// again whenever the mouse moves, and wants the last answer. Jobs that write files are all done instead, one
// after the other, also when the task goes. Without threads take() does a job.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/files/read_scope.h"
#include "base/own_thread.h"

namespace trace {

/// Asked now and then by a long job; true: the answer is not needed any more.
using Cancelled = std::function<bool()>;

/// Told now and then by a long job which share of it is done; false: it is to stop.
using Advance = std::function<bool(double)>;

/// Which jobs of a BackgroundTask are done.
enum class Jobs { newest, all };

template <class Answer>
class BackgroundTask {
 public:
  using Work = std::function<Answer(const Cancelled&)>;  ///< does not throw

  explicit BackgroundTask(Jobs jobs = Jobs::newest, Threads threads = Threads::own)
      : all_(jobs == Jobs::all), thread_(ownThread(threads, [this] { loop(); })) {}
  ~BackgroundTask() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable())
      thread_.join();
    else
      loop();  // what is still to be done
  }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// If only the newest counts: takes the place of a job that waits; one that runs may still answer, and
  /// after a moment it is cancelled.
  void start(Work work) {
    {
      const std::lock_guard lock(mutex_);
      if (!all_) waiting_.clear();
      waiting_.push_back([work = std::move(work), rules = ReadScope::current()](const Cancelled& cancelled) {
        const ReadScope scope(rules);
        return work(cancelled);
      });
    }
    wake_.notify_all();
  }

  /// The last answer, or the first of all, once. Without threads does a job that waits.
  std::optional<Answer> take() {
    if (!thread_.joinable()) doNext();
    const std::lock_guard lock(mutex_);
    if (answers_.empty()) return {};
    std::optional<Answer> answer(std::move(answers_.front()));
    answers_.pop_front();
    return answer;
  }

  /// There is an answer to come.
  bool busy() const {
    const std::lock_guard lock(mutex_);
    return running_ || !waiting_.empty();
  }
  /// take() has an answer, or without threads makes one.
  bool hasNews() const {
    const std::lock_guard lock(mutex_);
    return !answers_.empty() || (!thread_.joinable() && !waiting_.empty());
  }
  /// There is an answer to come or to be taken.
  bool pending() const {
    const std::lock_guard lock(mutex_);
    return running_ || !waiting_.empty() || !answers_.empty();
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// While the mouse moves, each answer that comes this soon is worth being shown.
  static constexpr std::chrono::milliseconds kPatience{200};

  void loop() {
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        running_ = false;
        wake_.wait(lock, [&] { return quit_ || !waiting_.empty(); });
        if (waiting_.empty() || (quit_ && !all_)) return;
      }
      doNext();
    }
  }

  void doNext() {
    Work work;
    {
      const std::lock_guard lock(mutex_);
      if (waiting_.empty()) return;  // another one took its place
      work = std::move(waiting_.front());
      waiting_.pop_front();
      running_ = true;
    }
    const Clock::time_point began = Clock::now();
    const auto cancelled = [&] {
      if (all_) return false;
      const std::lock_guard lock(mutex_);
      return quit_ || (!waiting_.empty() && Clock::now() - began > kPatience);
    };
    Answer answer = work(cancelled);
    if (cancelled()) return;
    const std::lock_guard lock(mutex_);
    if (!all_) answers_.clear();
    answers_.push_back(std::move(answer));
    running_ = false;
  }

  const bool all_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Work> waiting_;
  bool running_ = false, quit_ = false;
  std::deque<Answer> answers_;
  std::thread thread_;
};

}  // namespace trace
