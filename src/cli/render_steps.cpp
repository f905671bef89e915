#include "cli/render_steps.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/lint/lint.h"
#include "app/session/picture_layers.h"
#include "app/session/render_warnings.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/os/memory.h"
#include "cli/commands/commands.h"
#include "cli/text/statistics_text.h"
#include "image/codecs/codec.h"
#include "image/srgb.h"
#include "render/picture/passes.h"
#include "render/picture/render.h"
#include "render/samples/sampler.h"

namespace trace::cli {
namespace {

/// The checkpoint of the picture, or of the part of it that the session renders.
Checkpoint checkpointOf(const Session& session, const PictureFiles& files) {
  return {files.path(), session.metadata(), session.settings(), programText(), session.film().share()};
}

/// Fills the session's film from the checkpoint, if it is of the same picture, and tells.
void goOnFrom(Checkpoint& checkpoint, Session& session, const Arguments& arguments, const Console& console,
              Progress& progress, const Part& part) {
  if (checkpoint.load(session.film())) {
    const Film& film = session.film();
    const double share = static_cast<double>(film.samplesDone()) /
                         static_cast<double>(film.ownTiles() * film.waves().back().end);
    progress.beginsAfter((static_cast<double>(part.before) + film.shareDone()) /
                         static_cast<double>(part.all));
    console.line(LogLevel::info, "continuing from " + checkpoint.path() + ", " +
                                     std::to_string(static_cast<int>(100 * share)) + " % done");
    return;
  }
  if (!checkpoint.whyNot().empty())
    console.line(LogLevel::info,
                 "note: the render starts from the beginning; " + checkpoint.whyNot() +
                     (!checkpoint.damaged()              ? ""
                      : arguments.resume == Resume::keep ? "; it is left there"
                                                         : "; it is removed when the picture is finished"));
  if (const GeneratorRow& generator = generatorOf(session.settings());
      arguments.resume == Resume::keep && !generator.continues)
    console.line(LogLevel::info, "note: samples of \"" + std::string(generator.name) +
                                     "\" are placed by their number, so that none can be added later; "
                                     "--sampling sobol allows it");
}

std::string regionText(const Region& r) {
  return std::to_string(r.x0) + "," + std::to_string(r.y0) + "," + std::to_string(r.x1) + "," +
         std::to_string(r.y1);
}
std::string pixelsText(const Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels";
}

}  // namespace

std::string pictureFor(const Scene& scene, const std::string& named) {
  if (!named.empty()) return named;
  if (scene.file == kStandardInput) return "stdin.png";
  return !scene.picture.empty() ? scene.picture
                                : std::filesystem::path(scene.file).stem().generic_string() + ".png";
}

void checkPlaces(const Session& session, const std::string& output) {
  for (const Output& file : outputs(output, session.settings())) {
    checkIsNoInput(file.path, session.scene().inputs);
    checkWritable(file.path);
  }
}

void checkOutputs(const Session& session, const std::string& output, const Console& console) {
  const Size size = session.size();
  const Region& region = session.settings().region;
  if (region.x0 >= size.width || region.y0 >= size.height)
    throw Error(Fault::usage,
                "the region " + regionText(region) + " is outside the picture of " + pixelsText(size));
  const Tile left = areaOf(region, size);
  if (!region.whole() && (left.x1 < region.x1 || left.y1 < region.y1))
    console.line(LogLevel::warning, "warning: the region " + regionText(region) +
                                        " goes beyond the picture of " + pixelsText(size) + ": " +
                                        regionText({left.x0, left.y0, left.x1, left.y1}) + " is rendered");
  const Settings& settings = session.settings();
  if (settings.alpha && (!storesAlpha(output) || isAnaglyph(settings.stereo)))
    console.line(LogLevel::warning, "warning: --alpha: " + output +
                                        " has no alpha, and the environment behind the scene is black; "
                                        ".png and .exr store it");
  if (const int taken = samplesOf(settings); taken > settings.spp && !subdivides(settings))
    console.line(LogLevel::info, "note: --sampling " + std::string(generatorOf(settings).name) + " takes " +
                                     std::to_string(taken) + " samples a pixel, the next square after " +
                                     std::to_string(settings.spp) + "; --sampling sobol takes any number");
  for (const Output& file : outputs(output, session.settings()))
    checkEncodable(pictureFormatFor(file.path), size.width, size.height);
  checkPlaces(session, output);
}

RenderResult renderPictureWatched(Session& session, const Arguments& arguments, Signals& signals,
                                  const Console& console, Progress& progress, PictureFiles& files,
                                  const Part& part) {
  Checkpoint checkpoint = checkpointOf(session, files);
  if (arguments.resume != Resume::never) goOnFrom(checkpoint, session, arguments, console, progress, part);
  const double every = session.settings().checkpointEvery;
  RenderResult result;
  {
    const CheckpointPlan plan{every > 0 ? &checkpoint : nullptr, every};
    const Watch watch(session, signals, console, progress, files, plan, part);
    result = session.renderPicture();
  }
  const bool keeps = result.end != End::finished || arguments.resume == Resume::keep;
  if (keeps && every > 0 && session.job().done > 0) {
    os::liftMemoryLimit();
    saveCheckpoint(checkpoint, session.film(), progress, console);
  }
  return result;
}

std::string settleCheckpoint(const Session& session, const RenderResult& result, const Arguments& arguments,
                             const PictureFiles& files) {
  Checkpoint checkpoint = checkpointOf(session, files);
  if (result.end != End::finished) {
    const bool never = arguments.resume == Resume::never;
    if (!checkpoint.exists()) return "";
    return never ? "; without --resume=never the same command continues from there"
                 : "; the same command continues from there";
  }
  if (arguments.resume != Resume::keep) checkpoint.remove(session.film());
  return "";
}

void reportOldCheckpoints(const Session& session, const PictureFiles& files, const Console& console) {
  const auto others = checkpointOf(session, files).others();
  if (others.empty()) return;
  std::error_code ignored;
  std::uintmax_t bytes = 0;
  std::string names;
  for (const std::string& file : others) {
    if (const auto size = std::filesystem::file_size(file, ignored); !ignored) bytes += size;
    names += file.find(' ') == std::string::npos ? " " + file : " \"" + file + "\"";
  }
  char size[40];
  std::snprintf(size, sizeof size, "%.1f MB", static_cast<double>(bytes) / 1e6);
  const bool one = others.size() == 1;
  console.line(LogLevel::info, "note: " + counted(others.size(), "checkpoint") +
                                   " of other options or scenes " + (one ? "is" : "are") +
                                   " next to the picture, " + size + "; to remove " + (one ? "it" : "them") +
                                   ": rm" + names);
}

void reportLosses(const Session& session, const RenderResult& result, const Console& console,
                  bool tellsLimit) {
  const BudgetScope unlimited(nullptr);  // the time may be over
  if (const double removed = static_cast<double>(result.statistics.lightRemoved) / Statistics::kLightParts;
      removed > 0 && tellsLimit) {
    const Picture picture = session.film().picture(), counts = session.film().sampleCounts();
    double light = 0, samples = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      light += luminanceOf(picture.pixels[i]) * counts.pixels[i].r;
      samples += counts.pixels[i].r;
    }
    const auto cast =  // by this run, and not by those before it that left a checkpoint
        static_cast<double>(result.statistics.rays[static_cast<std::size_t>(RayKind::camera)]);
    const double kept = light * cast / std::max(samples, 1.0);
    constexpr double kMuch = 0.05;  // then it is no longer a few specks, but light that paths find too rarely
    const double share = removed / (removed + kept);
    const bool isFoundOtherwise = share > kMuch && hasTrait(session.settings(), Trait::bounces) &&
                                  !hasTrait(session.settings(), Trait::photons);
    char text[200];
    std::snprintf(
        text, sizeof text,
        "note: --firefly-limit took away %.2g %% of the light, in its brightest samples; %s0 keeps it",
        100 * share, isFoundOtherwise ? "--integrator photon may find it without noise; " : "");
    console.line(LogLevel::info, text);
  }
  if (const std::string doubt = brightnessDoubt(session.settings(), result.brightnessError); !doubt.empty())
    console.line(LogLevel::warning, "warning: " + doubt);
  if (result.statistics.badSamples == 0) return;
  std::string text = counted(result.statistics.badSamples, "sample") +
                     (result.statistics.badSamples == 1 ? " was" : " were") + " not finite and left out";
  if (!result.badSamples.empty())
    text += "; first at pixel " + std::to_string(result.badSamples[0].x) + "," +
            std::to_string(result.badSamples[0].y);
  console.line(LogLevel::warning, "warning: " + text);
}

namespace {

/// The steps behind the last ray have so many seconds beyond the limit of the command.
constexpr double kFinishing = 5;

/// Gives them to the command's budget for as long as it lives.
class FinishingTime {
 public:
  FinishingTime() : budget_(budgetOfThread.budget), limit_(budget_ ? budget_->timeLimit() : 0) {
    if (limit_ > 0) budget_->limitTime(std::max(limit_, budget_->seconds()) + kFinishing);
  }
  ~FinishingTime() {
    if (budget_) budget_->limitTime(limit_);
  }
  FinishingTime(const FinishingTime&) = delete;
  FinishingTime& operator=(const FinishingTime&) = delete;

  bool isOver() const { return budget_ && budget_->timeIsOver(); }
  std::string brokenOff() const { return budget_ ? budget_->brokenOff() : ""; }

 private:
  Budget* const budget_;
  const double limit_;
};

/// In its place, or, if that cannot be written, elsewhere. Throws what the budget throws.
SavedPicture saveSomewhere(Session& session, PictureFiles& files, LastSteps finish, const Console& console) {
  try {
    return {session.save(files, finish), false, {}, finish};
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    console.error(error);
  }
  std::vector<std::string> inPlace = files.written();
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path folder = makeOwnFolder();
  PictureFiles others = session.filesFor((folder / fs::path(files.path()).filename()).generic_string());
  try {
    return {session.save(others, finish), true, inPlace, finish};
  } catch (const Error& error) {
    fs::remove(folder, ignored);  // if it is empty
    inPlace.insert(inPlace.end(), others.written().begin(), others.written().end());
    if (error.fault() == Fault::limit || inPlace.empty()) throw;
    console.error(error);
    return {"", true, inPlace, finish};
  } catch (...) {
    fs::remove(folder, ignored);
    throw;
  }
}

/// "--denoise, --bloom and the passes", those that the settings ask for.
std::string longSteps(const Settings& settings) {
  std::vector<std::string> steps;
  if (settings.denoise) steps.emplace_back("--denoise");
  if (settings.bloom > 0) steps.emplace_back("--bloom");
  if (!passesOf(settings).empty()) steps.emplace_back("its passes");
  std::string text;
  for (std::size_t i = 0; i < steps.size(); ++i)
    text += (i == 0 ? "" : i + 1 < steps.size() ? ", " : " and ") + steps[i];
  return text;
}

}  // namespace

SavedPicture save(Session& session, RenderResult& result, const Arguments& arguments, Signals& signals,
                  PictureFiles& files, Progress& progress, const Console& console) {
  os::liftMemoryLimit();  // what is done is kept
  signals.finishingBegins(result.end == End::cancelled);
  const bool finished = result.end == End::finished;
  std::string doing;
  {
    const FinishingTime time;
    try {
      return saveSomewhere(session, files, LastSteps::all, console);
    } catch (const StoppedByUser&) {
      result.end = End::cancelled;
    } catch (const Error&) {
      if (!time.isOver()) throw;
      if (finished) result.end = End::timeLimit;
    }
    doing = time.brokenOff();
  }
  const BudgetScope unlimited(nullptr);
  bool kept = !finished;  // then it has a checkpoint, if there are to be any
  if (finished && session.settings().checkpointEvery > 0) {
    Checkpoint checkpoint = checkpointOf(session, files);
    kept = saveCheckpoint(checkpoint, session.film(), progress, console);
  }
  progress.clear();
  const std::string steps = longSteps(session.settings());
  console.line(LogLevel::warning,
               "warning: stopped" + (doing.empty() ? "" : " while " + doing) + ": the picture is written" +
                   (steps.empty() ? "" : " without " + steps) +
                   (kept && arguments.resume != Resume::never ? "; its samples are kept" : ""));
  return saveSomewhere(session, files, LastSteps::plain, console);
}

namespace {

/// "there is out.png".
std::string thereText(const std::vector<std::string>& files) {
  std::string names;
  for (const std::string& name : files) names += (names.empty() ? "" : ", ") + name;
  return std::string(files.size() == 1 ? "there is " : "there are ") + names;
}

}  // namespace

std::string lostText(const SavedPicture& saved) {
  return "not all files could be written; " + thereText(saved.inPlace);
}

std::string whereText(const SavedPicture& saved, const std::string& wanted) {
  if (!saved.elsewhere) return saved.path == wanted ? "" : "; " + keptText(wanted);
  if (saved.inPlace.empty()) return " instead of " + wanted;
  return ", because not all files could be written in their place; " + thereText(saved.inPlace);
}

std::string removedText(const PictureFiles& files) {
  std::string names;
  for (const std::string& name : files.removed()) names += (names.empty() ? "; removed " : ", ") + name;
  return names;
}

bool reportStatistics(const Arguments& arguments, Session& session, const RenderResult& result,
                      const std::string& written, double seconds, const Console& console) {
  if (arguments.stats == StatsStyle::none) return true;
  const BudgetScope unlimited(nullptr);
  const Run run{session, result, written, session.job().fraction(), seconds, os::peakMemory()};
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
  const char* with = settings.passFormat == PassFormat::layers ? " with the pass" : " and the pass";
  return with + std::string(names.find(',') == std::string::npos ? " " : "es ") + names;
}

std::function<std::optional<Message>()> whyUnlitIn(const Session& session) {
  return [&] { return whyUnlit(session.scene(), session.settings(), session.world()); };
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
