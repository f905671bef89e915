#include "library/watched_work.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/files/read_scope.h"

namespace traceray {

std::exception_ptr runWatched(trace::Budget& budget, const std::function<void()>& work,
                              const OnProgress& progress, const std::function<double()>& fraction,
                              const std::function<void()>& stop) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::mutex mutex;
  std::condition_variable changed;
  bool isDone = false;
  std::exception_ptr failure, thrown;
  const auto rules = trace::ReadScope::current();
  std::thread thread([&] {
    const trace::BudgetScope scope(&budget);
    const trace::ReadScope files(rules);
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    isDone = true;
    changed.notify_one();
  });
  bool isStopped = false;
  for (bool done = false; !done;) {
    try {
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      if (!isStopped && !progress({fraction(), seconds})) {
        isStopped = true;
        stop();
      }
    } catch (...) {
      thrown = std::current_exception();
      isStopped = true;
      stop();
    }
    std::unique_lock lock(mutex);
    done = changed.wait_for(lock, std::chrono::milliseconds(100), [&] { return isDone; });
  }
  thread.join();
  if (thrown) return thrown;
  if (failure) std::rethrow_exception(failure);
  return nullptr;
}

}  // namespace traceray
