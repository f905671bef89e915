#include "base/parallel.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/budget.h"
#include "base/files/read_scope.h"

namespace trace {

int hardwareThreads() { return std::max(1u, std::thread::hardware_concurrency()); }

void parallelChunks(std::int64_t chunks, int threads, Job& job,
                    const std::function<void(std::int64_t, int)>& work, const ChunkSizes& sizes) {
  if (threads <= 0) threads = hardwareThreads();
  threads = static_cast<int>(std::min<std::int64_t>(threads, std::max<std::int64_t>(chunks, 1)));
  job.total = sizes.of ? sizes.total : chunks;

  std::atomic<std::int64_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const BudgetOfThread budget = budgetOfThread;
  const std::shared_ptr<const ReadRules> reading = ReadScope::current();
  const auto pull = [&](int worker) {
    const BudgetScope scope(budget);
    const ReadScope mayRead(reading);
    try {
      while (!job.cancel) {
        const std::int64_t chunk = next.fetch_add(1);
        if (chunk >= chunks) return;
        work(chunk, worker);
        job.done += sizes.of ? sizes.of(chunk) : 1;
      }
    } catch (const GivenUp&) {  // the job is cancelled: nothing more is begun
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = chunks;
    }
  };

  std::vector<std::thread> workers;
  try {
    for (int worker = 1; worker < threads; ++worker) workers.emplace_back(pull, worker);
  } catch (const std::system_error&) {
    // The system gives no more threads: those that started do the work.
  }
  pull(0);
  for (std::thread& worker : workers) worker.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace trace
