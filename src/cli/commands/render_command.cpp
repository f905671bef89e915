// ray [render] SCENE [OUT]: read, check that the picture can be written, render, write, report.
//
// Whatever ends the render early (Ctrl-C, the time limit), the finished tiles are written. With --frames it
// renders an animation instead (frames.h).
#include <algorithm>
#include <chrono>
#include <filesystem>

#include "app/session/remaining_time.h"
#include "app/session/session.h"
#include "base/files/file.h"
#include "base/os/console.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/frames.h"
#include "cli/parts.h"
#include "cli/render_steps.h"
#include "cli/terminal/terminal.h"
#include "cli/text/help.h"
#include "cli/text/metric_text.h"
#include "cli/text/scene_facts.h"
#include "image/codecs/codec.h"

namespace trace::cli {
namespace {

namespace fs = std::filesystem;

/// The picture's file as named on the command line; empty if it is not.
std::string outputName(const Arguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  if (files.empty())
    throw Error(Fault::usage, "expected the name of a scene file, found none", "ray SCENE [OUT]");
  if (files.size() > 2)
    throw Error(Fault::usage, "expected a scene and at most one picture, found also \"" + files[2] + "\"");
  if (files.size() == 2 && !arguments.output.empty() && arguments.output != files[1])
    throw Error(Fault::usage,
                "two names for the picture: \"" + arguments.output + "\" and \"" + files[1] + "\"");
  if (files.size() == 2) return files[1];
  return arguments.output;
}

/// Where no scene was meant but a command or a flag, that is what to tell, before anything about the words
/// after it.
void checkIsScene(const std::string& scene, std::size_t operands) {
  std::error_code ignored;
  if (scene == kStandardInput || fs::exists(scene, ignored)) return;
  if (scene.starts_with('+'))  // as POV-Ray has them
    throw Error(Fault::usage, "unknown flag \"" + scene + "\"", "flags begin with - or --, as in -w 640");
  std::vector<std::string_view> names;
  for (const Command& command : commands()) names.push_back(command.name);
  const std::string name = nearest(scene, names);
  if (!name.empty())
    throw Error(Fault::io, "there is no file \"" + scene + "\"",
                "did you mean the command \"ray " + name + "\"?");
  if (operands > 1 && scene.find_first_of("./\\") == std::string::npos)
    throw Error(Fault::usage, "there is no command \"" + scene + "\"",
                scene == "frames" || scene == "animate" ? "ray SCENE --frames 0-23 renders an animation"
                                                        : "ray --help lists the commands");
}

constexpr std::string_view kStandardOutput = "-";

/// Where a picture lies until it is whole, which then goes to the standard output; removed with this.
class PictureForStdout {
 public:
  explicit PictureForStdout(const std::string& format)
      : folder_(makeOwnFolder()), picture_((folder_ / ("picture." + format)).generic_string()) {}
  ~PictureForStdout() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  PictureForStdout(const PictureForStdout&) = delete;
  PictureForStdout& operator=(const PictureForStdout&) = delete;

  const std::string& picture() const { return picture_; }

 private:
  const fs::path folder_;
  const std::string picture_;
};

/// Renders to a file and writes that to the standard output; nothing is left beside it.
int renderToStdout(const Arguments& arguments, const Console& console) {
  const std::string format = arguments.format.value_or("png");
  pictureFormatFor("picture." + format);
  if (!arguments.frames.empty() || arguments.part > 0)
    throw Error(Fault::usage, "-o -: expected one picture, found --frames or --part", "-o FILE");
  if (arguments.stats == StatsStyle::json)
    throw Error(Fault::usage, "-o - and --stats=json both write to the standard output",
                "--stats prints a table to "
                "the terminal");
  if (os::isScreen(os::Stream::result))
    throw Error(Fault::usage, "-o -: the standard output is a terminal, which shows no picture",
                "ray SCENE -o - | PROGRAM, or -o picture.png");
  const PictureForStdout file(format);
  Arguments own = arguments;
  own.files.resize(1);
  own.output = file.picture();
  own.resume = Resume::never;
  own.choices.push_back({"checkpoint-every", "0", {}});
  own.toStdout = true;
  return renderCommand(own, console);
}

}  // namespace

int renderCommand(const Arguments& arguments, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  if (arguments.printDefaults) {
    printResult(defaultsText());
    return kDone;
  }

  if (!arguments.files.empty()) checkIsScene(arguments.files[0], arguments.files.size());
  const std::string named = outputName(arguments);
  if (named == kStandardOutput) return renderToStdout(arguments, console);
  if (arguments.format && !arguments.toStdout)
    throw Error(Fault::usage, "--format is for a picture that -o - writes to the standard output",
                "the name of another file chooses its format, as in -o out.exr");
  if (arguments.part > 0) return renderPart(arguments, named, console);
  if (!arguments.frames.empty()) {
    const std::string frames = fs::path(arguments.files[0]).stem().generic_string() + ".####.png";
    return renderFrames(arguments, named.empty() ? frames : named, console);
  }
  if (!named.empty()) pictureFormatFor(named);  // an unknown ending is told before a large scene is read
  Signals signals;
  Session session;
  session.open(arguments.files[0], arguments.choices, arguments.strict);
  const std::string output = pictureFor(session.scene(), named);
  checkPlaces(session, output);
  if (arguments.toStdout && outputs(output, session.settings()).size() > 1)
    throw Error(Fault::usage, "-o -: the passes have no files of their own",
                "--format exr --pass-format layers writes them with the picture");
  signals.preparingBegins();
  try {
    session.setFramesPerSecond(arguments.framesPerSecond);
    session.build();  // a lack of memory is the better reason to refuse a huge picture
  } catch (const StoppedByUser&) {
    console.last(false, "stopped by the user: nothing written, for nothing was finished");
    return kStopped;
  }
  checkOutputs(session, output, console);
  console.warnings(session.messages().all());
  const auto isRegion = [](const Choice& choice) { return choice.option == "region"; };
  if (std::any_of(arguments.choices.begin(), arguments.choices.end(), isRegion) && !arguments.quick &&
      session.settings().region.whole() &&
      std::none_of(session.scene().choices.begin(), session.scene().choices.end(), isRegion))
    console.line(LogLevel::warning,
                 "warning: --region 0,0,0,0 has no pixel in it: all of the picture is rendered");
  for (const OptionFact& fact : changedOptions(session.scene(), session.settings(), arguments.choices))
    console.line(LogLevel::debug, "option " + fact.name + " = " + fact.value + " (" + fact.from + ")");

  signals.renderingBegins();
  Progress progress = makeProgress(arguments.progress, console);
  PictureFiles files = session.filesFor(output);
  RenderResult result = renderPictureWatched(session, arguments, signals, console, progress, files, Part{});
  reportLosses(session, result, console);

  std::optional<Message> aid;
  if (result.end == End::finished) aid = session.firstAid(whyUnlitIn(session));
  if (session.job().done == 0) {  // a black picture is worth less than what the file may hold now
    console.line(LogLevel::error, whyStopped(result) + "nothing written, for nothing was finished");
    return exitCode(result);
  }
  const SavedPicture saved = save(session, result, arguments, signals, files, progress, console);
  const std::string stopped = whyStopped(result);
  int code = saved.elsewhere ? kFailed : exitCode(result);
  const std::string goesOn = saved.path.empty() ? "" : settleCheckpoint(session, result, arguments, files);
  if (result.end == End::finished) reportOldCheckpoints(session, files, console);
  if (aid) console.warnings({&*aid, 1});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!reportStatistics(arguments, session, result, saved.path, seconds, console)) code = kFailed;
  if (saved.path.empty()) {
    console.last(false, stopped + lostText(saved) + goesOn);
    return code;
  }
  std::string cleaned;
  if (const auto change = files.denoiseChange())
    cleaned = "; --denoise changed it by " + numberText(*change) + " levels on the average";
  std::string noise;
  if (result.end == End::finished && !arguments.quick)
    noise = noiseText(session.settings(), session.film()) +
            fireflyText(session.settings(), session.world(), session.film());
  std::string chosen = chosenText(session.scene(), session.settings(), session.measuredExposure());
  if (!chosen.empty()) chosen.insert(0, "; ");
  const std::string passes = saved.finish == LastSteps::all ? andPasses(session.settings()) : "";
  if (arguments.toStdout) printFile(readFile(saved.path));
  const std::string written = arguments.toStdout ? "the picture to the standard output" : saved.path;
  console.last(code == kDone, stopped + "wrote " + written + passes + " (" +
                                  pictureText(session, session.job().fraction()) + ") in " +
                                  durationText(seconds) + whereText(saved, output) + noise + cleaned +
                                  removedText(files) + goesOn + chosen);
  return code;
}

}  // namespace trace::cli
