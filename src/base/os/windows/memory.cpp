#include "base/os/memory.h"

#include <new>

#include "base/os/windows/api.h"

namespace trace::os {
namespace {

PROCESS_MEMORY_COUNTERS counters() {
  PROCESS_MEMORY_COUNTERS all{};
  all.cb = sizeof all;
  ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &all, sizeof all);
  return all;
}

/// This process is alone in its job, which has the limit.
HANDLE job = nullptr;

bool setLimit(std::uint64_t bytes, DWORD flags) {
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = flags;
  limits.ProcessMemoryLimit = bytes;
  return ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
}

}  // namespace

std::uint64_t machineMemory() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  return ::GlobalMemoryStatusEx(&status) ? status.ullTotalPhys : std::uint64_t{2} << 30;
}

std::uint64_t peakMemory() { return counters().PeakWorkingSetSize; }

bool limitMemory(std::uint64_t bytes, int threads) {
  constexpr std::uint64_t kStack = 8 << 20;
  if (!job) {
    job = ::CreateJobObjectW(nullptr, nullptr);
    if (!job || !::AssignProcessToJobObject(job, ::GetCurrentProcess())) return false;
  }
  const std::uint64_t all = counters().PagefileUsage + bytes + static_cast<std::uint64_t>(threads) * kStack;
  return setLimit(all, JOB_OBJECT_LIMIT_PROCESS_MEMORY);
}

void liftMemoryLimit() {
  if (job) setLimit(0, 0);
}

void keepFreedMemory() {}

// Large pages take a right that users do not have.
bool isLarge(std::size_t) { return false; }
void* allocateLarge(std::size_t bytes) { return ::operator new(bytes); }
void freeLarge(void* memory, std::size_t) { ::operator delete(memory); }

}  // namespace trace::os
