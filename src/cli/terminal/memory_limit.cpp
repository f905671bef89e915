#include "cli/terminal/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>

#include "base/error.h"
#include "base/sanitized.h"

namespace trace::cli {
namespace {

#if defined(__linux__)
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
#endif

void say(const char* text) {
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody is left to hear it
}

[[noreturn]] void onTerminate() {
  liftMemoryLimit();
  bool lacksMemory = false;
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    lacksMemory = true;
  } catch (...) {
  }
  say(lacksMemory ? "error: out of memory\nnothing written: out of memory\n"
                  : "error: Trace failed in an unexpected way: please report this\n");
  if (lacksMemory) ::_exit(static_cast<int>(Fault::limit));
  std::abort();
}

}  // namespace

bool limitMemory(std::uint64_t bytes, int threads) {
#if defined(__linux__)
  if (kSanitized) return false;  // they keep terabytes of addresses
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return false;
  const std::uint64_t all = dataInUse() + bytes + static_cast<std::uint64_t>(threads) * stackSize();
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= all) return false;  // somebody allows less
  limit.rlim_cur = all;
  return ::setrlimit(RLIMIT_DATA, &limit) == 0;
#else
  static_cast<void>(bytes), static_cast<void>(threads);
  return false;
#endif
}

void liftMemoryLimit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_DATA, &limit);
}

void endWithMessage() { std::set_terminate(onTerminate); }

}  // namespace trace::cli
