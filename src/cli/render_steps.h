// The steps that rendering one picture and rendering the frames of an animation have in common.
#pragma once

#include <chrono>
#include <string>

#include "app/session.h"
#include "cli/arguments.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "cli/watch.h"

namespace trace::cli {

/// Throws Error unless all files of the render can be written and hold a picture of its size, in which
/// something is to be rendered.
void checkOutputs(const Session& session, const std::string& output);

/// Renders with an eye on progress and signals.
RenderResult renderWatched(Session& session, Signals& signals, const Console& console, Progress& progress,
                           const std::string& output, const Part& part);

/// Warns of samples that were left out.
void reportBadSamples(const RenderResult& result, const Console& console);

/// Writes the picture and its passes, to the folder for temporary files if their own place fails after all.
/// Returns the picture's name.
std::string save(Session& session, const std::string& output, const Console& console);

/// What --stats asked for, if it did.
void reportStatistics(const Arguments& arguments, Session& session, const RenderResult& result,
                      const std::string& written, double seconds, const Console& console);

/// " and the passes depth, id"; "" without passes.
std::string andPasses(const Settings& settings);

/// "stopped by the user: " and the like; "" if the render is finished.
std::string whyStopped(const RenderResult& result);
int exitCode(const RenderResult& result);

}  // namespace trace::cli
