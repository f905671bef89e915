// Work in numbered chunks that any number of threads pull from one queue.
//
// The chunk, never the worker, selects the data, so a result cannot depend on the number of threads.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace trace {

/// How the owner of a running job watches and stops it, from any thread.
struct Job {
  std::atomic<bool> cancel{false};      ///< set to stop after the chunks now in work
  std::chrono::seconds patience{5};     ///< for which those may continue then; set before the job begins
  std::atomic<std::int64_t> done{0};    ///< finished work: chunks, or their sizes
  std::atomic<std::int64_t> total{0};   ///< the same of all chunks; 0 until known
  std::atomic<std::int64_t> before{0};  ///< that was done when the job began: done counts it too
  double fraction() const {
    const std::int64_t all = total.load();
    return all > 0 ? static_cast<double>(done.load()) / static_cast<double>(all) : 0.0;
  }
};

/// Thrown by a chunk that a cancelled job no longer waits for: it does not count as done.
struct GivenUp {};

/// The number of hardware threads, at least 1.
int hardwareThreads();

/// How much work chunks are, where they differ.
struct ChunkSizes {
  std::int64_t total = 0;  ///< total of all
  std::function<std::int64_t(std::int64_t chunk)> of;
};

/// Calls work(chunk, worker) once for each chunk in [0, chunks), from `threads` workers (numbered from
/// 0; the calling thread is one of them; 0 threads means all the hardware has). Returns when all is done
/// or the job is cancelled. An exception from `work` stops the queue and is rethrown here.
void parallelChunks(std::int64_t chunks, int threads, Job& job,
                    const std::function<void(std::int64_t chunk, int worker)>& work,
                    const ChunkSizes& sizes = {});

}  // namespace trace
