// ray [render] SCENE [OUT]: read, check that the picture can be written, render, write, report.
//
// Whatever ends the render early (Ctrl-C, the time limit), the finished tiles are written.
#include <algorithm>
#include <chrono>
#include <filesystem>

#include "app/session.h"
#include "base/file.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/help.h"
#include "cli/scene_facts.h"
#include "cli/statistics_text.h"
#include "cli/terminal.h"
#include "cli/watch.h"
#include "image/codec.h"
#include "render/passes.h"

namespace trace::cli {
namespace {

namespace fs = std::filesystem;

/// The picture's file: as named, or the scene's name with .png in the current folder.
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
  if (!arguments.output.empty()) return arguments.output;
  return fs::path(files[0]).stem().string() + ".png";
}

void open(Session& session, const Arguments& arguments) {
  const std::string& scene = arguments.files[0];
  try {
    session.open(scene, arguments.choices, arguments.strict);
  } catch (const Error& error) {  // perhaps no scene was meant
    std::vector<std::string_view> names;
    for (const Command& command : commands()) names.push_back(command.name);
    const std::string name = nearest(scene, names);
    std::error_code ignored;
    if (error.fault() != Fault::io || name.empty() || fs::exists(scene, ignored)) throw;
    Message message = error.messages().front();
    message.hint = "did you mean the command \"ray " + name + "\"?";
    throw Error(Fault::io, {message});
  }
}

/// Writes the picture and its passes, to the folder for temporary files if their own place fails after all.
/// Returns the picture's name.
std::string save(Session& session, const std::string& output, const Console& console) {
  try {
    session.save(output);
    return output;
  } catch (const Error& error) {
    console.error(error);
  }
  const std::string elsewhere = (fs::temp_directory_path() / fs::path(output).filename()).string();
  session.save(elsewhere);
  return elsewhere;
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

/// "the passes depth, id".
std::string passNames(const Settings& settings) {
  std::string names;
  for (const PassRow* pass : passesOf(settings))
    names += (names.empty() ? "" : ", ") + std::string(pass->name);
  return (names.find(',') == std::string::npos ? "the pass " : "the passes ") + names;
}

/// Renders with an eye on progress and signals.
RenderResult watched(Session& session, Signals& signals, const Console& console, ProgressStyle style,
                     const std::string& output) {
  const Watch watch(session, signals, console, style, output);
  return session.render();
}

}  // namespace

int render(const Arguments& arguments, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  if (arguments.printDefaults) return printResult(defaultsText()), kDone;

  const std::string output = outputName(arguments);
  pictureFormatFor(output);  // an unknown ending is told before a large scene is read
  Signals signals;
  Session session;
  open(session, arguments);
  const std::vector<Output> files = outputs(output, session.settings());
  for (const Output& file : files) checkWritable(file.path);
  session.build();
  const Size size =
      session.size();  // only now: a lack of memory is the better reason to refuse a huge picture
  for (const Output& file : files) checkEncodable(pictureFormatFor(file.path), size.width, size.height);
  console.warnings(session.messages().all());
  for (const OptionFact& fact : changedOptions(session.scene(), session.settings(), arguments.choices))
    console.line(LogLevel::debug, "option " + fact.name + " = " + fact.value + " (" + fact.from + ")");

  signals.renderingBegins();
  const RenderResult result = watched(session, signals, console, arguments.progress, output);
  const double fraction = session.job().fraction();
  reportBadSamples(result, console);

  const std::string stopped = result.end == End::cancelled   ? "stopped by the user: "
                              : result.end == End::timeLimit ? "stopped by the time limit: "
                              : result.end == End::failed    ? "broke off (" + result.failure + "): "
                                                             : "";
  int code = result.end == End::cancelled   ? kStopped
             : result.end == End::timeLimit ? static_cast<int>(Fault::limit)
             : result.end == End::failed    ? kFailed
                                            : kDone;
  if (session.job().done == 0) {  // a black picture is worth less than what the file may hold now
    console.line(LogLevel::error, stopped + "nothing written, for nothing was finished");
    return code;
  }
  const std::string written = save(session, output, console);
  if (written != output) code = kFailed;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (arguments.stats != StatsStyle::none) {
    const Run run{session, result, written, fraction, seconds, peakMemory()};
    if (arguments.stats == StatsStyle::json)
      printResult(statisticsJson(run) + "\n");
    else
      console.line(LogLevel::error, statisticsTable(run));
  }
  const std::string passes = files.size() > 1 ? " and " + passNames(session.settings()) : "";
  console.line(LogLevel::error, stopped + "wrote " + written + passes + " (" +
                                    pictureText(session, fraction) + ") in " + durationText(seconds) +
                                    (written == output ? "" : " instead of " + output));
  return code;
}

}  // namespace trace::cli
