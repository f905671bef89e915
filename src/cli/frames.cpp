#include "cli/frames.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "app/session/remaining_time.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/render_steps.h"
#include "formats/format.h"
#include "image/codecs/codec.h"

namespace trace::cli {
namespace {

void open(Session& session, const Arguments& arguments, int frame) {
  std::vector<Choice> choices = arguments.choices;
  choices.push_back(momentOf(arguments, frame));
  session.open(arguments.files[0], choices, arguments.strict);
}

/// Is every file of the frame there, made with these settings?
bool isThere(const Arguments& arguments, int frame, const std::string& picture) {
  std::error_code ignored;
  if (!std::filesystem::exists(picture, ignored)) return false;  // spares reading the scene
  Session session;
  open(session, arguments, frame);
  const std::vector<Output> files = outputs(picture, session.settings());
  const Metadata metadata = session.metadata();
  return std::all_of(files.begin(), files.end(), [&](const Output& file) {
    return isRendered(file, file.pass.empty() ? finished(session.size(), session.settings()) : session.size(),
                      metadata);
  });
}

/// Throws Error if a frame lies where the scene reads from: better told before the first one is rendered.
void checkAllPlaces(const Session& session, const std::string& pattern, const std::vector<int>& frames) {
  std::error_code ignored;
  for (const int frame : frames)
    for (const Output& file : outputs(frameName(pattern, frame), session.settings()))
      if (std::filesystem::exists(file.path, ignored)) checkIsNoInput(file.path, session.scene().inputs);
}

/// Where the command stopped, and how to continue: all frames from `stoppedAt` on are still to come.
std::string howToGoOn(const std::vector<int>& frames, int stoppedAt) {
  const std::string first = std::to_string(stoppedAt);
  std::string rest = first;
  if (stoppedAt != frames.back()) rest += "-" + std::to_string(frames.back());
  if (const int step = frames.size() > 1 ? frames[1] - frames[0] : 1; step > 1 && rest != first)
    rest += "/" + std::to_string(step);
  return "; stopped at frame " + first + ": --frames " + rest + " goes on there";
}

/// "a.0000.png to a.0099.png".
std::string span(const std::string& pattern, const std::vector<int>& frames) {
  const std::string first = frameName(pattern, frames.front());
  return frames.size() == 1 ? first : first + " to " + frameName(pattern, frames.back());
}

}  // namespace

Choice momentOf(const Arguments& arguments, int frame) {
  for (const Choice& choice : arguments.choices)
    if (choice.option == "time")
      throw Error(Fault::usage, "--frames and --time cannot be given together",
                  "a frame shows the moment of its number divided by --fps");
  return {"time", toText(frame / arguments.framesPerSecond), {}};
}

std::vector<Choice> exposureOfAll(const Arguments& arguments) {
  Session first;
  open(first, arguments, 0);
  if (!first.settings().autoExposure) return {};
  first.build();
  return {{"auto-exposure", "off", {}}, {"exposure", toText(first.settings().exposure), {}}};
}

std::string frameName(const std::string& pattern, int frame) {
  const std::size_t last = pattern.rfind('#');
  if (last == std::string::npos) return pattern;
  const std::size_t before = pattern.find_last_not_of('#', last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1, length = last - first + 1;
  std::string number = std::to_string(frame);
  if (number.size() < length) number.insert(0, length - number.size(), '0');
  return pattern.substr(0, first) + number + pattern.substr(last + 1);
}

int renderFrames(const Arguments& given, const std::string& pattern, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  pictureFormatFor(pattern);
  Arguments arguments = given;
  const std::string& scene = arguments.files[0];
  const auto neverChanges = [&] {
    Messages toldLater;
    SceneTime time(arguments.frames.front() / arguments.framesPerSecond);
    readScene(scene, readFile(scene), toldLater, time);
    return !time.changesScene();
  };
  if (arguments.frames.size() > 1 && neverChanges())
    console.line(LogLevel::warning,
                 "warning: nothing in " + scene +
                     " changes with time, so all frames are the same picture; key(...) and "
                     "particles in the scene change (docs/animation.md)");
  if (arguments.frames.size() > 1 && pattern.find('#') == std::string::npos)
    throw Error(Fault::usage,
                "expected a name with #### for the number of the frame, found \"" + pattern + "\"",
                "-o frame.####.png");
  if (!keepsWords(pattern))
    console.line(LogLevel::info, "note: " + std::filesystem::path(pattern).extension().generic_string() +
                                     " files cannot say how they were made, so frames that are there are "
                                     "rendered again; those of .png are skipped");
  Signals signals;
  for (Choice& choice : exposureOfAll(arguments)) arguments.choices.push_back(std::move(choice));
  std::vector<int> missing;
  for (int frame : arguments.frames)
    if (!isThere(arguments, frame, frameName(pattern, frame))) missing.push_back(frame);
  const std::size_t there = arguments.frames.size() - missing.size();
  const std::string skipped = there > 0 ? std::to_string(there) + " already there" : "";
  if (missing.empty()) {
    console.last(true, "nothing to write: " + span(pattern, arguments.frames) + " are already there");
    return kDone;
  }

  Progress progress = makeProgress(arguments.progress, console);
  int code = kDone;
  std::string size, stopped, removed;
  std::size_t done = 0;
  for (; done < missing.size(); ++done) {
    const std::string picture = frameName(pattern, missing[done]);
    Session session;
    try {
      open(session, arguments, missing[done]);
      if (done == 0) checkOutputs(session, picture, console);
      if (done == 0) checkAllPlaces(session, pattern, missing);
      checkPlaces(session, picture);
      signals.preparingBegins();
      session.setFramesPerSecond(arguments.framesPerSecond);
      session.build();
    } catch (const StoppedByUser&) {
      RenderResult cancelled;
      cancelled.end = End::cancelled;
      code = exitCode(cancelled);
      stopped = whyStopped(cancelled);
      break;
    } catch (const Error& error) {
      if (done == 0) throw;  // then nothing is written, which is what the last line says
      const Budget* budget = budgetOfThread.budget;
      code = static_cast<int>(error.fault());
      if (error.fault() == Fault::limit && budget && budget->timeIsOver()) {
        RenderResult late;
        late.end = End::timeLimit;
        stopped = whyStopped(late);
      } else {
        console.error(error);
        stopped = "broke off: ";
      }
      break;
    }
    if (done == 0) console.warnings(session.messages().all());
    signals.renderingBegins();
    const auto frameStart = elapsed();
    const Part part{start, static_cast<std::int64_t>(done), static_cast<std::int64_t>(missing.size())};
    PictureFiles files = session.filesFor(picture);
    RenderResult result = renderPictureWatched(session, arguments, signals, console, progress, files, part);
    reportLosses(session, result, console, done == 0);
    if (result.end != End::finished) {
      code = exitCode(result);
      stopped = whyStopped(result);
      break;
    }
    const SavedPicture saved = save(session, result, arguments, signals, files, progress, console);
    if (result.end != End::finished) {  // a stop in the steps behind the last ray
      code = exitCode(result);
      stopped = whyStopped(result);
      break;
    }
    if (!saved.path.empty()) settleCheckpoint(session, result, arguments, files);
    if (!reportStatistics(arguments, session, result, saved.path, elapsed() - frameStart, console))
      code = kFailed;
    if (saved.elsewhere) {
      code = kFailed;
      stopped = "frame " + std::to_string(missing[done]) + ": " +
                (saved.path.empty() ? lostText(saved) : "wrote " + saved.path + whereText(saved, picture)) +
                "; ";
      break;
    }
    removed += removedText(files);
    size = pictureText(session, 1) + andPasses(session.settings());
    console.line(LogLevel::debug, "wrote " + picture);
    if (done + 1 < missing.size())
      signals.lastLineIs(
          "stopped at once by the user: wrote " +
          span(pattern, {missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(done + 1)}) + " (" +
          std::to_string(done + 1) + " of " + std::to_string(missing.size()) + " frames)" +
          howToGoOn(arguments.frames, missing[done + 1]));
  }

  const std::string what =
      done == 0
          ? "nothing written"
          : "wrote " + span(pattern, {missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(done)});
  const std::string of = done < missing.size() ? " of " + std::to_string(missing.size()) : "";
  console.last(
      code == kDone,
      stopped + what + " (" + (of.empty() ? counted(done, "frame") : std::to_string(done) + of + " frames") +
          (size.empty() ? "" : ", " + size) + (skipped.empty() ? "" : "; " + skipped) + ") in " +
          durationText(elapsed()) + removed + (of.empty() ? "" : howToGoOn(arguments.frames, missing[done])));
  return code;
}

}  // namespace trace::cli
