#include "base/os/memory.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <new>

#include "base/os/linux.h"
#include "base/sanitized.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace trace::os {
namespace {

#if defined(TRACE_OS_LINUX)
/// The memory of this process that counts for the limit; 0 if the system does not say.
std::uint64_t dataInUse() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  file >> size >> resident >> shared >> text >> library >> data;
  return file ? data * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

std::uint64_t stackSize() {
  constexpr std::uint64_t kUsual = 8 << 20, kMost = 64 << 20;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUsual;
  return std::min<std::uint64_t>(limit.rlim_cur, kMost);
}

std::size_t inPages(std::size_t bytes) { return (bytes + kLargePage - 1) / kLargePage * kLargePage; }
#endif

}  // namespace

std::uint64_t machineMemory() {
#if defined(_SC_PHYS_PAGES) && !defined(__EMSCRIPTEN__)
  std::uint64_t bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  std::uint64_t limit = 0;
  if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit) bytes = std::min(bytes, limit);
  return bytes;
#else
  return std::uint64_t{2} << 30;  // a browser's address space
#endif
}

std::uint64_t peakMemory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
#if defined(__APPLE__)
  return static_cast<std::uint64_t>(usage.ru_maxrss);
#else
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
#endif
}

#if defined(TRACE_OS_LINUX)

bool limitMemory(std::uint64_t bytes, int threads) {
  if (kSanitized) return false;  // they keep terabytes of addresses
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return false;
  const std::uint64_t all = dataInUse() + bytes + static_cast<std::uint64_t>(threads) * stackSize();
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= all) return false;  // somebody allows less
  limit.rlim_cur = all;
  return ::setrlimit(RLIMIT_DATA, &limit) == 0;
}

void liftMemoryLimit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_DATA, &limit);
}

bool isLarge(std::size_t bytes) { return bytes >= 2 * kLargePage; }

/// Whole huge pages; a page more is mapped, and what lies before and behind them given back.
void* allocateLarge(std::size_t bytes) {
  const std::size_t mapped = inPages(bytes);
  void* all =
      ::mmap(nullptr, mapped + kLargePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();
  char* const begin = static_cast<char*>(all);
  const std::size_t before = (kLargePage - reinterpret_cast<std::uintptr_t>(all) % kLargePage) % kLargePage;
  if (before > 0) ::munmap(begin, before);
  if (before < kLargePage) ::munmap(begin + before + mapped, kLargePage - before);
  ::madvise(begin + before, mapped, MADV_HUGEPAGE);
  return begin + before;
}

void freeLarge(void* memory, std::size_t bytes) { ::munmap(memory, inPages(bytes)); }

#else

bool limitMemory(std::uint64_t, int) { return false; }
void liftMemoryLimit() {}
bool isLarge(std::size_t) { return false; }
void* allocateLarge(std::size_t bytes) { return ::operator new(bytes); }
void freeLarge(void* memory, std::size_t) { ::operator delete(memory); }

#endif

void keepFreedMemory() {
#if defined(__GLIBC__)
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

}  // namespace trace::os
