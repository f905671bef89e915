// ray new, ray format, ray expand: commands about the text of a scene.
#include <algorithm>
#include <filesystem>

#include "app/editing/first_scene.h"
#include "app/session/output.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "cli/commands/commands.h"
#include "formats/ray/file/format.h"
#include "formats/ray/language/expansion.h"
#include "formats/ray/syntax/layout.h"
#include "formats/ray/write/patch.h"
#include "formats/text_front.h"

namespace trace::cli {
namespace {

namespace fs = std::filesystem;

/// The one file of a command. Throws Error(Fault::usage) for none or several.
const std::string& onlyFile(const Arguments& arguments, const std::string& command) {
  if (arguments.files.size() == 1) return arguments.files[0];
  throw Error(Fault::usage, "ray " + command + ": expected the name of one scene file, found " +
                                (arguments.files.empty() ? "none" : std::to_string(arguments.files.size())));
}

/// Throws Error(Fault::scene) if it is no text of a .ray file.
void checkIsRay(const std::string& file, const TextFront& front, const char* command) {
  if (!recognisesRay(front.text()))
    throw Error(
        Fault::scene, SourcePlace{.file = file}, "expected a scene that begins with SBT-raytracer or Trace",
        std::string("ray ") + command + " knows the language of .ray files; ray convert reads others");
}

/// The text to `output`, or to standard output if that is empty.
void deliver(const std::string& text, const std::string& output, const Console& console) {
  if (output.empty()) return printResult(text);
  writeFile(output, text);
  console.line(LogLevel::info, "wrote " + output);
}

}  // namespace

int newCommand(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() > 1)
    throw Error(Fault::usage,
                "ray new: expected the name of one scene, found " + std::to_string(arguments.files.size()));
  fs::path file = arguments.files.empty() ? fs::path("scene.ray") : fs::path(arguments.files[0]);
  if (file.extension().empty()) file += ".ray";
  if (file.extension() != ".ray" && file.extension() != ".tr")
    throw Error(Fault::usage,
                "ray new: expected a name that ends in .ray or .tr, found \"" + file.generic_string() + "\"");
  std::error_code ignored;
  if (fs::exists(file, ignored))
    throw Error(Fault::usage,
                "there is a file \"" + file.generic_string() + "\", and ray new overwrites nothing",
                "ray new other.ray");
  checkWritable(file.generic_string());
  writeFile(file.generic_string(), sceneNamed(kFirstScene, file.filename().generic_string()));
  console.last(true, "wrote " + file.generic_string() + "; next: ray " + file.generic_string());
  return kDone;
}

int formatCommand(const Arguments& arguments, const Console& console) {
  const std::string& file = onlyFile(arguments, "format");
  if (arguments.inPlace && !arguments.output.empty())
    throw Error(Fault::usage, "ray format: expected --in-place or -o, found both");
  if (arguments.inPlace && file == kStandardInput)
    throw Error(Fault::usage, "ray format: expected a file with --in-place, found the standard input",
                "ray format - prints the tidied scene");
  const std::string bytes = readInput(file);
  const TextFront front(file, bytes);
  checkIsRay(file, front, "format");
  if (arguments.inPlace && (front.wasEncoded() || front.wasCut()))
    throw Error(Fault::usage, "ray format --in-place: " + file + " is no plain text, and would become one",
                "ray format " + file + " -o OUT writes another file");
  const std::string text = tidied(file, front.text());
  if (!arguments.inPlace) {
    if (!arguments.output.empty()) checkDistinct(file, arguments.output);
    deliver(text, arguments.output, console);
    return kDone;
  }
  if (text == bytes) {
    console.line(LogLevel::info, file + " is tidy");
    return kDone;
  }
  deliver(text, file, console);
  return kDone;
}

int expandCommand(const Arguments& arguments, const Console& console) {
  const Work work("expanding the scene");
  const std::string& file = onlyFile(arguments, "expand");
  if (!arguments.output.empty()) checkDistinct(file, arguments.output);
  const std::string bytes = readInput(file);
  const TextFront front(file, bytes);
  checkIsRay(file, front, "expand");
  const Settings given = resolve({arguments.choices});
  const ReadScope scope = ReadScope::ofScene(file);
  Expansion expansion = expansionOf(file, front.text(), given.time);
  if (!arguments.output.empty()) {
    checkIsNoInput(arguments.output, expansion.inputs);
    expansion.text = withNamesSeenFrom(expansion.text, file, arguments.output);
  }
  if (expansion.changesWithTime)
    console.line(LogLevel::warning, "warning: " + file + " changes with time: this is the moment " +
                                        findOption("time").get(given) + " s; --time chooses another");
  deliver(expansion.text, arguments.output, console);
  return kDone;
}

}  // namespace trace::cli
