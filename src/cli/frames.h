// The frames of an animation, one after the other: ray render SCENE --frames A-B.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/terminal/console.h"

namespace trace::cli {

/// The name with its last run of # replaced by the number, with as many digits at least.
std::string frameName(const std::string& pattern, int frame);

/// The moment that the frame shows, as a choice. Throws Error(Fault::usage) beside a choice of --time.
Choice momentOf(const Arguments& arguments, int frame);

/// One exposure for all frames, where it is automatic: that of frame 0, so that a frame is the same picture
/// in every run. Throws Error.
std::vector<Choice> exposureOfAll(const Arguments& arguments);

/// Renders the frames that are not there yet, each whole or not at all. `pattern` holds #### for the number.
/// Returns the exit code. Throws Error.
int renderFrames(const Arguments& arguments, const std::string& pattern, const Console& console);

}  // namespace trace::cli
