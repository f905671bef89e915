#include "cli/commands/commands.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "app/session/session.h"
#include "app/session/version.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "base/os/memory.h"
#include "base/parallel.h"
#include "base/text.h"
#include "cli/terminal/overseer.h"
#include "cli/terminal/terminal.h"
#include "cli/text/help.h"
#include "image/codecs/picture_name.h"

namespace trace::cli {
namespace {

const Command* findCommand(std::string_view name) {
  for (const Command& command : commands())
    if (command.name == name) return &command;
  return nullptr;
}

/// The page of the command; of `help` and of no command that of all.
std::string page(const Command* command, bool all) {
  return command && command->name != "help" ? helpText(*command, all) : helpText(all);
}

int helpCommand(const Arguments& arguments, const Console&) {
  const std::vector<std::string>& words = arguments.files;
  const Command* command = words.empty() ? nullptr : findCommand(words[0]);
  const std::size_t place = command ? 1 : 0;  // index after the word "all"
  const bool all = words.size() > place && words[place] == "all";
  if (words.size() > place + all) {
    std::vector<std::string_view> known{"all"};
    for (const Command& c : commands()) known.push_back(c.name);
    const std::string& odd = words[place + all];
    throw Error(Fault::usage, "ray help: expected a command, \"all\" or nothing, found \"" + odd + "\"",
                place + all == 0 ? didYouMean(odd, known) : "");
  }
  printResult(page(command, all));
  return kDone;
}

/// For the last line, after the messages have told what it was. `understood`: the words of the command line
/// are right.
std::string whyNothing(const Error& error, bool understood) {
  switch (error.fault()) {
    case Fault::io: return "a file could not be read or written";
    case Fault::usage:
      return understood ? "the command cannot be followed" : "the command line is not right; see ray --help";
    case Fault::scene: {
      const std::size_t errors = error.messages().size();
      const bool perhapsMore = errors == Messages::kMostErrors;  // where reading ends
      return std::string("the scene has ") + (perhapsMore ? "at least " : "") + counted(errors, "error");
    }
    case Fault::limit: return "a limit of size, memory or time was reached";
  }
  return "it failed";
}

/// The exit code of what went wrong.
int codeOf(const Command& command, const Arguments& arguments, Fault fault) {
  return command.failed ? command.failed(arguments) : static_cast<int>(fault);
}

/// Within the limits of memory and time that the command line gives.
int runLimited(const Command& command, const Arguments& arguments, const Console& console, Budget& budget) {
  if (command.verb == Verb::gui) return command.run(arguments, console);  // has no end of its own
  const Settings given = resolve({arguments.choices});
  os::limitMemory(allowedMemory(given), given.threads > 0 ? given.threads : hardwareThreads());
  budget.limitTime(given.timeLimit);
  const BudgetScope scope(&budget);
  const ReadScope reading(allowedFiles(arguments));
  const Overseer overseer(budget, console, arguments.progress,
                          {codeOf(command, arguments, Fault::limit), command.writes});
  return command.run(arguments, console);
}

/// Runs the row, and turns everything that can go wrong into messages and an exit code. `named`: the command
/// was typed.
int runCommand(const Command& command, const std::vector<std::string>& words, bool named) {
  endWithMessage();
  Budget budget(Signals::look);
  Console console;
  Arguments arguments;
  std::string why;
  Fault fault = Fault::io;
  bool understood = false;
  try {
    arguments = parse(words, command.verb);
    understood = true;
    console = Console(arguments.logLevel, arguments.quiet);
    if (arguments.help) {
      printResult(page(named ? &command : nullptr, arguments.helpAll));
      return kDone;
    }
    if (arguments.version) {
      printResult(versionText() + "\n");
      return kDone;
    }
    return runLimited(command, arguments, console, budget);
  } catch (const Error& error) {
    os::liftMemoryLimit();
    console.error(error);
    why = whyNothing(error, understood);
    fault = error.fault();
  } catch (const ReaderGone&) {
    return kReaderGone;
  } catch (const std::bad_alloc&) {
    os::liftMemoryLimit();
    console.error(outOfMemory(budget.brokenOff()));
    why = "out of memory";
    fault = Fault::limit;
  } catch (const std::length_error&) {  // more of something than addresses
    console.error(outOfMemory(budget.brokenOff()));
    why = "out of memory";
    fault = Fault::limit;
  } catch (const std::system_error& error) {
    const bool noThread = error.code() == std::errc::resource_unavailable_try_again;
    fault = noThread ? Fault::limit : Fault::io;
    os::liftMemoryLimit();
    why = noThread ? "memory for threads is missing" : "the system refused";
    console.error(noThread ? Error(fault, "the system starts no more threads",
                                   "a thread needs memory for its stack; -t 1 takes one")
                           : Error(fault, error.what()));
  } catch (const std::exception& error) {
    why = "it failed";
    console.error(Error(fault, error.what()));
  }
  if (command.writes) console.line(LogLevel::error, "nothing written: " + why);
  return understood ? codeOf(command, arguments, fault) : static_cast<int>(fault);
}

/// Nothing was typed, and there is no window to open: as the courses' programs did, it renders a scene of its
/// own, if its files are not there yet.
int runAlone() {
  constexpr const char* kScene = "scene.ray";
  const Console console;
  console.lines(LogLevel::error, briefHelp());
  std::error_code ignored;
  if (std::filesystem::exists(kScene, ignored) || std::filesystem::exists("scene.png", ignored)) {
    console.error(noWindow());
    return static_cast<int>(Fault::usage);
  }
  if (const int code = run({"new", kScene}); code != kDone) return code;
  return run({kScene, "--quality", "draft"});
}

}  // namespace

Error outOfMemory(const std::string& doing, const std::string& file) {
  return {Fault::limit, SourcePlace{.file = file}, "out of memory" + (doing.empty() ? "" : " while " + doing),
          "--max-memory N allows N MiB; the default is half of the machine's memory"};
}

std::vector<std::string> allowedFiles(const Arguments& arguments) {
  std::vector<std::string> allowed = arguments.allowRead;
  for (const Choice& choice : arguments.choices)
    if (findOption(choice.option).kind == Option::Kind::file) allowed.push_back(choice.value);
  return allowed;
}

void checkDistinct(const std::string& read, const std::string& written) {
  if (!written.empty() && sameFile(pictureName(read).file, written))
    throw Error(Fault::usage, "\"" + read + "\" and \"" + written + "\" are the same file",
                "inputs are not overwritten; name another file");
}

std::string_view chosenFormat(const Arguments& arguments, std::string_view command,
                              std::span<const std::string_view> known) {
  if (!arguments.format) return known.front();
  for (std::string_view name : known)
    if (arguments.format == name) return name;
  std::string expected;
  for (std::string_view name : known) expected += (expected.empty() ? "" : " | ") + std::string(name);
  throw Error(Fault::usage,
              "ray " + std::string(command) + " --format: expected " + expected + ", found \"" +
                  *arguments.format + "\"",
              didYouMean(*arguments.format, known));
}

const Command& commandOf(Verb verb) { return commands()[static_cast<std::size_t>(verb)]; }

std::string namesOf(Verbs verbs) {
  std::string names;
  for (const Command& command : commands())
    if (verbs.has(command.verb)) names += (names.empty() ? "" : ", ") + std::string(command.name);
  return names;
}

std::span<const Command> commands() {
  static constexpr std::array kTable{
      Command{Verb::render, "render", "SCENE [OUT]",
              "render a scene to a picture file; the word render may be left out", true, renderCommand,
              nullptr, "the picture; by default the scene's name with .png, in this folder"},
      Command{Verb::gui, "gui", "[SCENE]",
              "open the studio, a window that renders and shows the rays; ray alone does too, and without a "
              "studio or a display renders a first scene",
              false, guiCommand},
      Command{Verb::info, "info", "SCENE", "the contents of a scene, and the settings of a render", false,
              infoCommand},
      Command{Verb::bench, "bench", "SCENE",
              "how fast the scene's rays are answered, and how large its hierarchies are", false,
              benchCommand},
      Command{Verb::explain, "explain", "SCENE --pixel X,Y",
              "why a pixel has its colour: every ray, with its numbers", false, explainCommand, nullptr,
              "the answer, or the drawing of --format; by default it is printed"},
      Command{Verb::lint, "lint", "SCENE", "look for likely mistakes in a scene", false, lintCommand, nullptr,
              "the findings; by default they are printed"},
      Command{Verb::diff, "diff", "A B",
              "how far two pictures are apart, in numbers and as a picture, and why", false, diffCommand,
              failedDiff, "a picture of the difference"},
      Command{Verb::grade, "grade", "DIR --reference DIR",
              "compare a folder of pictures or scenes, or a class of them, with reference pictures", false,
              gradeCommand, nullptr, "a page of all pictures, .html"},
      Command{Verb::convert, "convert", "IN [OUT]",
              "write a scene or mesh in another format, by the suffix of OUT", true, convertCommand},
      Command{Verb::texture, "texture", "[NAME|SCENE:NAME [-o OUT]]",
              "write a texture as a picture, or list its fields; alone, list the textures", false,
              textureCommand, nullptr, "a picture of the texture"},
      Command{Verb::materials, "materials", "[NAME] [-o OUT]",
              "list the library of materials, or one of it; with -o a picture of balls made of them", false,
              materialsCommand, nullptr, "a picture of balls made of the materials"},
      Command{Verb::newScene, "new", "[SCENE]", "write a first scene to start from, with comments", true,
              newCommand},
      Command{Verb::format, "format", "SCENE [-o OUT]",
              "print a scene with its layout tidied, or write it back with --in-place", false, formatCommand,
              nullptr, "the tidied scene; by default it is printed"},
      Command{Verb::expand, "expand", "SCENE [-o OUT]",
              "print a scene with its loops, functions and included files expanded", false, expandCommand,
              nullptr, "the expanded scene; by default it is printed"},
      Command{Verb::stereogram, "stereogram", "SCENE -o OUT", "make a random-dot stereogram of the scene",
              true, stereogramCommand, nullptr, "the picture of dots"},
      Command{Verb::split, "split", "SCENE --parts N",
              "divide a render among machines: a folder of jobs for make or Slurm", true, splitCommand,
              nullptr, "the folder of the parts; by default the scene's name with .parts, in this folder"},
      Command{
          Verb::farm, "farm", "SCENE --parts N [-o OUT]",
          "render a picture by a cluster with Slurm: submit the parts, those that are lost again, and merge",
          true, farmCommand, nullptr,
          "the picture; by default the scene's name with .png, in this folder; its parts are beside it"},
      Command{Verb::merge, "merge", "FOLDER [-o OUT]",
              "put the parts of ray split together to the picture that one machine renders", true,
              mergeCommand, nullptr, "the picture; by default the scene's name with .png, in this folder"},
      Command{Verb::features, "features", "", "extras, picture and scene formats, integrators", false,
              featuresCommand, nullptr,
              "the file of what is printed, or a folder for the page and the pictures of --examples"},
      Command{Verb::selftest, "selftest", "",
              "check this build against exact results; a certificate with -o FILE", false, selftestCommand,
              nullptr, "a certificate"},
      Command{Verb::help, "help", "[COMMAND] [all]", "print help, of one command, or all of it", false,
              helpCommand},
  };
  return kTable;
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) return opensWindows() ? run({"gui"}) : runAlone();
  if (const Command* command = findCommand(words.front()))
    return runCommand(*command, {words.begin() + 1, words.end()}, true);
  return runCommand(commands().front(), words, false);
}

}  // namespace trace::cli
