// The steps that rendering one picture and rendering the frames of an animation have in common.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "cli/arguments.h"
#include "cli/terminal/console.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/terminal.h"
#include "cli/terminal/watch.h"

namespace trace::cli {

/// The picture's file as named, or where the scene wants it, or the scene's name with .png in the current
/// folder.
std::string pictureFor(const Scene& scene, const std::string& named);

/// Throws Error unless all files of the render can be written, without a loss of what the scene is made of.
void checkPlaces(const Session& session, const std::string& output);

/// Throws Error unless all files of the render can be written and hold a picture of its size, in which
/// something is to be rendered. Warns where that is less than --region names.
void checkOutputs(const Session& session, const std::string& output, const Console& console);

/// Renders with an eye on progress and signals: from the picture's checkpoint on, if there is one, and leaves
/// one if it stops early.
RenderResult renderPictureWatched(Session& session, const Arguments& arguments, Signals& signals,
                                  const Console& console, Progress& progress, PictureFiles& files,
                                  const Part& part);

/// After the picture has been written: takes the checkpoint of a whole one away, unless it is to be kept.
/// Returns how to continue from that of a part, as the end of a line; "" where there is none.
std::string settleCheckpoint(const Session& session, const RenderResult& result, const Arguments& arguments,
                             const PictureFiles& files);

/// Tells of checkpoints of other pictures that lie beside a finished one, which nothing else takes away.
void reportOldCheckpoints(const Session& session, const PictureFiles& files, const Console& console);

/// For Session::firstAid(): what lint finds of the lights. Refers to the session.
std::function<std::optional<Message>()> whyUnlitIn(const Session& session);

/// Warns of samples that were left out, and tells what the firefly limit took away, if that is asked for.
void reportLosses(const Session& session, const RenderResult& result, const Console& console,
                  bool tellsLimit = true);

struct SavedPicture {
  std::string path;        ///< the picture's name; "" if it, or a pass, could be written nowhere
  bool elsewhere = false;  ///< not where it should be, nor beside it
  /// Files that are in their places although the picture is elsewhere, the picture first; or, if it could be
  /// written nowhere, the files that could be.
  std::vector<std::string> inPlace{};
  LastSteps finish = LastSteps::all;
};
/// Writes the picture and its passes; if their own place fails after all, to a new folder among the system's
/// temporary files. The steps from the last ray on are given some seconds beyond the time limit. If they take
/// longer, or the user stops them, what was traced is kept in a checkpoint, if there are to be any, and the
/// picture is written without the steps that take long; the end of `result` says so.
SavedPicture save(Session& session, RenderResult& result, const Arguments& arguments, Signals& signals,
                  PictureFiles& files, Progress& progress, const Console& console);

/// "not all files could be written; there is out.png", of a picture that has no path.
std::string lostText(const SavedPicture& saved);

/// Where the picture is, if it is not where it should be: "; old.png is kept as it is" and the like.
std::string whereText(const SavedPicture& saved, const std::string& wanted);

/// "; removed out.partial.png", of the fragments that the whole picture took away; "" for none.
std::string removedText(const PictureFiles& files);

/// Prints the statistics of --stats, if it was given. False, after a message, if stdout does not take it.
bool reportStatistics(const Arguments& arguments, Session& session, const RenderResult& result,
                      const std::string& written, double seconds, const Console& console);

/// " and the passes depth, id"; "" without passes.
std::string andPasses(const Settings& settings);

/// "stopped by the user: " and the like; "" if the render is finished.
std::string whyStopped(const RenderResult& result);
int exitCode(const RenderResult& result);

}  // namespace trace::cli
