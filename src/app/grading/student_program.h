// A student's own program, run on a scene in a sandbox (base/sandbox.h): what `ray grade --class --run` does.
#pragma once

#include <string>

#include "app/compare/difference.h"
#include "base/sandbox.h"

namespace trace {

/// How programs are run; an empty command: none is.
struct ProgramRun {
  std::string command;  ///< for a shell, with {scene} and {out}
  SandboxLimits limits;
  bool isolated = true;
};

/// The picture that the program in `folder` makes of the scene. `suffix` is that of the picture's name.
/// `cpuSeconds` receives the processor time, also of a program that fails. Throws Error with the reason why
/// there is no picture, and what the budget of the thread throws.
LoadedPicture programPicture(const ProgramRun& run, const std::string& folder, const std::string& scene,
                             const std::string& suffix, double& cpuSeconds);

/// Throws Error(Fault::usage) unless the command names {scene} and {out}, and programs can be isolated here
/// or need not be.
void checkRun(const ProgramRun& run);

}  // namespace trace
