#include "cli/render_steps.h"

#include <filesystem>

#include "base/file.h"
#include "cli/commands.h"
#include "cli/memory_limit.h"
#include "cli/statistics_text.h"
#include "image/codec.h"
#include "render/passes.h"

namespace trace::cli {

void checkPlaces(const Session& session, const std::string& output) {
  for (const Output& file : outputs(output, session.settings())) {
    checkIsNoInput(file.path, session.scene().inputs);
    checkWritable(file.path);
  }
}

void checkOutputs(const Session& session, const std::string& output) {
  const Size size = session.size();
  const Region& region = session.settings().region;
  if (region.x0 >= size.width || region.y0 >= size.height)
    throw Error(Fault::usage, "the region is outside the picture of " + std::to_string(size.width) + " x " +
                                  std::to_string(size.height) + " pixels");
  for (const Output& file : outputs(output, session.settings()))
    checkEncodable(pictureFormatFor(file.path), size.width, size.height);
  checkPlaces(session, output);
}

RenderResult renderPictureWatched(Session& session, Signals& signals, const Console& console,
                                  Progress& progress, PictureFiles& files, const Part& part) {
  const Watch watch(session, signals, console, progress, files, part);
  return session.renderPicture();
}

void reportBadSamples(const RenderResult& result, const Console& console) {
  if (result.statistics.badSamples == 0) return;
  std::string text = counted(result.statistics.badSamples, "sample") +
                     (result.statistics.badSamples == 1 ? " was" : " were") + " not finite and left out";
  if (!result.badSamples.empty())
    text += "; first at pixel " + std::to_string(result.badSamples[0].x) + "," +
            std::to_string(result.badSamples[0].y);
  console.line(LogLevel::warning, "warning: " + text);
}

SavedPicture save(Session& session, PictureFiles& files, const Console& console) {
  liftMemoryLimit();  // what is done is kept
  try {
    return {session.save(files), false};
  } catch (const Error& error) {
    console.error(error);
  }
  namespace fs = std::filesystem;
  const fs::path folder = makeOwnFolder();
  try {
    return {session.save((folder / fs::path(files.path()).filename()).string()), true};
  } catch (...) {
    std::error_code ignored;
    fs::remove(folder, ignored);  // if it is empty
    throw;
  }
}

std::string removedText(const PictureFiles& files) {
  std::string names;
  for (const std::string& name : files.removed()) names += (names.empty() ? "; removed " : ", ") + name;
  return names;
}

bool reportStatistics(const Arguments& arguments, Session& session, const RenderResult& result,
                      const std::string& written, double seconds, const Console& console) {
  if (arguments.stats == StatsStyle::none) return true;
  const Run run{session, result, written, session.job().fraction(), seconds, peakMemory()};
  if (arguments.stats == StatsStyle::table) {
    console.lines(LogLevel::error, statisticsTable(run));
    return true;
  }
  try {
    printResult(statisticsJson(run) + "\n");
  } catch (const ReaderGone&) {  // who wanted them does not any more
  } catch (const Error& error) {
    console.error(error);
    return false;
  }
  return true;
}

std::string andPasses(const Settings& settings) {
  std::string names;
  for (const PassRow* pass : passesOf(settings))
    names += (names.empty() ? "" : ", ") + std::string(pass->name);
  if (names.empty()) return "";
  return (names.find(',') == std::string::npos ? " and the pass " : " and the passes ") + names;
}

std::string whyStopped(const RenderResult& result) {
  switch (result.end) {
    case End::cancelled: return "stopped by the user: ";
    case End::timeLimit: return "stopped by the time limit: ";
    case End::outOfMemory: return "stopped for lack of memory: ";
    case End::failed: return "broke off (" + result.failure + "): ";
    case End::finished: break;
  }
  return "";
}

int exitCode(const RenderResult& result) {
  switch (result.end) {
    case End::cancelled: return kStopped;
    case End::timeLimit:
    case End::outOfMemory: return static_cast<int>(Fault::limit);
    case End::failed: return kFailed;
    case End::finished: break;
  }
  return kDone;
}

}  // namespace trace::cli
