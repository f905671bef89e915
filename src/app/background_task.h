// A thread for answers that a window must not wait for. Of several jobs only the newest waits: a window asks
// again whenever the mouse moves, and wants the last answer.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace trace {

/// Asked now and then by a long job; true: nobody wants the answer any more.
using Cancelled = std::function<bool()>;

template <class Answer>
class BackgroundTask {
 public:
  using Work = std::function<Answer(const Cancelled&)>;  ///< does not throw

  BackgroundTask() : thread_([this] { loop(); }) {}
  ~BackgroundTask() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Takes the place of a job that waits. One that runs may still answer; after a moment it is cancelled.
  void start(Work work) {
    {
      const std::lock_guard lock(mutex_);
      waiting_ = std::move(work);
    }
    wake_.notify_all();
  }

  /// The last answer, once.
  std::optional<Answer> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
  }

  /// There is an answer to come.
  bool busy() const {
    const std::lock_guard lock(mutex_);
    return running_ || waiting_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// While the mouse moves, each answer that comes this soon is worth being shown.
  static constexpr std::chrono::milliseconds kPatience{200};

  void loop() {
    for (;;) {
      Work work;
      {
        std::unique_lock lock(mutex_);
        running_ = false;
        wake_.wait(lock, [&] { return quit_ || waiting_; });
        if (quit_) return;
        work = std::exchange(waiting_, nullptr);
        running_ = true;
      }
      const Clock::time_point began = Clock::now();
      const auto cancelled = [&] {
        const std::lock_guard lock(mutex_);
        return quit_ || (waiting_ && Clock::now() - began > kPatience);
      };
      Answer answer = work(cancelled);
      if (cancelled()) continue;
      const std::lock_guard lock(mutex_);
      answer_ = std::move(answer), running_ = false;
    }
  }

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Work waiting_;
  bool running_ = false, quit_ = false;
  std::optional<Answer> answer_;
  std::thread thread_;
};

}  // namespace trace
