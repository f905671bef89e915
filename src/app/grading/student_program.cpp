#include "app/grading/student_program.h"

#include "base/budget.h"
#include "base/error.h"
#include "base/printable.h"
#include "base/text.h"
#include "image/codecs/codec.h"

namespace trace {
namespace {

/// The last line that is not empty; "" if there is none.
std::string lastLine(std::string text) {
  constexpr std::size_t kMost = 200;
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  text = text.substr(text.rfind('\n') + 1);
  return printable(text.substr(0, kMost));
}

std::string megabytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MB"; }

/// How the program ended, in words that follow on its name.
std::string endText(const SandboxResult& result, const ProgramRun& run) {
  switch (result.end) {
    case SandboxResult::End::timeLimit:
      return "its program takes longer than the " + toText(run.limits.seconds) + " s that it may";
    case SandboxResult::End::killed: return "its program was ended by a signal (" + result.signal + ")";
    case SandboxResult::End::exited:
      if (!result.signal.empty()) return "its program was ended by a signal (" + result.signal + ")";
      return result.code == 0 ? "" : "its program ended with the exit code " + std::to_string(result.code);
    case SandboxResult::End::notIsolated:
    case SandboxResult::End::couldNotStart: return "its program was not run";
  }
  return "";
}

}  // namespace

LoadedPicture programPicture(const ProgramRun& run, const std::string& folder, const std::string& scene,
                             const std::string& suffix, double& cpuSeconds) {
  const Work work("running a student's program");
  SandboxJob job;
  job.command = run.command;
  job.folder = folder;
  job.input = scene;
  job.outputName = "picture" + suffix;
  job.limits = run.limits;
  job.isolated = run.isolated;
  const SandboxResult result = runSandboxed(job);
  // One that was stopped has taken more than its children that ended, of which alone the system tells.
  cpuSeconds = result.end == SandboxResult::End::exited ? result.cpuSeconds : -1;
  const std::string said = lastLine(result.said), end = endText(result, run);
  const auto fail = [&](std::string why) {
    if (why.empty()) why = end;
    if (!end.empty() && why != end) why += "; " + end;
    throw Error(Fault::io, why + (said.empty() ? "" : ": " + said));
  };
  if (result.output == SandboxResult::Output::tooLarge)
    fail("its picture is larger than the " + megabytes(run.limits.output) + " that it may have");
  const bool isKilled = !result.signal.empty() && result.output == SandboxResult::Output::none;
  if (result.end != SandboxResult::End::exited || isKilled) fail("");
  if (result.output == SandboxResult::Output::noFile) fail("what its program wrote is no regular file");
  if (result.output == SandboxResult::Output::none) fail("its program wrote no picture");
  const std::string name = "picture" + suffix;
  return {decodePicture(result.bytes, name), !pictureFormatOf(result.bytes, name).keepsBright, ""};
}

void checkRun(const ProgramRun& run) {
  if (run.command.empty()) return;
  for (const char* part : {"{scene}", "{out}"})
    if (run.command.find(part) == run.command.npos)
      throw Error(Fault::usage,
                  std::string("--run: expected a command with ") + part + ", found \"" + run.command + "\"",
                  "--run './ray {scene} {out}'");
  if (!run.isolated) return;
  if (const std::string why = whyNotIsolated(); !why.empty())
    throw Error(
        Fault::usage, "--run: students' programs cannot be kept apart here (" + why + "), and are not run",
        "--unsandboxed runs them in your account, with limits of time and memory only (docs/security.md)");
}

}  // namespace trace
