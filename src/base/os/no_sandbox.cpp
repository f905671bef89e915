// Where no way is known to keep a program apart.
#include "base/os/linux.h"

#if !defined(TRACE_OS_LINUX)

#include "base/sandbox.h"

namespace trace {

std::string inputPath(const SandboxJob& job) { return job.input; }
std::string outputPath(const SandboxJob& job, const std::string& ownFolder) {
  return ownFolder + "/" + job.outputName;
}
SandboxResult runSandboxed(const SandboxJob&) { return {.said = whyNotIsolated()}; }
std::string whyNotIsolated() { return "only Linux is known to keep a program apart"; }

}  // namespace trace

#endif
