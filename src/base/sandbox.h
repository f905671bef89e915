// Runs a program that nobody vouches for, as students hand it in: without the network, with a folder of its
// own, and with limits. Linux only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trace {

struct SandboxLimits {
  double seconds = 60;  ///< on the clock; of processor time each process has as much
  std::uint64_t memory = std::uint64_t{2} << 30;  ///< bytes of each process
  std::uint64_t output = std::uint64_t{64}
                         << 20;  ///< bytes of the file that is taken; four times that of all
};

struct SandboxJob {
  /// A line for /bin/sh, in which inputPath() and outputPath() name the files.
  std::string command;
  std::string folder;      ///< where the program lies and starts; it cannot write there
  std::string input;       ///< a file; the program may read all below its folder
  std::string outputName;  ///< without folders
  SandboxLimits limits;
  /// False: in the user's own account, with the limits of time and memory alone.
  bool isolated = true;
};

struct SandboxResult {
  enum class End {
    exited,         ///< `code` is its exit code
    killed,         ///< `code` is the signal that ended it
    timeLimit,      ///< it was stopped
    notIsolated,    ///< the kernel refuses; nothing was run
    couldNotStart,  ///< nothing was run
  } end = End::couldNotStart;
  int code = 0;
  std::string signal{};   ///< the name of the signal that ended it, or a program of its shell; else ""
  double cpuSeconds = 0;  ///< all its processes that ended before it or with it
  std::string said{};     ///< the end of what it printed, or why it was not run
  enum class Output { none, taken, tooLarge, noFile } output = Output::none;
  std::string bytes{};  ///< bytes of the output
};

/// The names of the files as the program sees them.
std::string inputPath(const SandboxJob& job);
std::string outputPath(const SandboxJob& job, const std::string& ownFolder);

/// Runs the program and waits for it. All processes that it started are dead afterwards, also if this throws
/// what the budget of the thread throws. `{scene}` and `{out}` in the command become the names of the files,
/// quoted for the shell.
SandboxResult runSandboxed(const SandboxJob& job);

/// Why programs cannot be isolated here; "" if they can.
std::string whyNotIsolated();

}  // namespace trace
