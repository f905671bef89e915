// CPU time, which other jobs on the machine do not lengthen the way they lengthen wall time.
#pragma once

#include <ctime>

namespace trace::bench {

inline double seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The CPU time of this thread: for kernels.
inline double threadSeconds() { return seconds(CLOCK_THREAD_CPUTIME_ID); }
/// The CPU time of all threads together: for builds, so that work handed to other threads is counted.
inline double processSeconds() { return seconds(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace trace::bench
