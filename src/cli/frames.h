// The frames of an animation, one after the other: ray render SCENE --frames A-B.
#pragma once

#include <string>

#include "cli/arguments.h"
#include "cli/console.h"

namespace trace::cli {

/// The name with its last run of # replaced by the number, with as many digits at least.
std::string frameName(const std::string& pattern, int frame);

/// Renders the frames that are not there yet, each whole or not at all. `pattern` holds #### for the number.
/// Returns the exit code. Throws Error.
int renderFrames(const Arguments& arguments, const std::string& pattern, const Console& console);

}  // namespace trace::cli
