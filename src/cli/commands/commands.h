// THE table of sub-commands. A new one is a value of Verb, a function and a row in commands.cpp.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/terminal/console.h"

namespace trace::cli {

/// Exit codes beside the values of Fault, which are the others.
inline constexpr int kDone = 0, kFailed = 1, kStopped = 4, kFound = 6;
/// Nobody reads the results any more: 128 + SIGPIPE, as shells report it.
inline constexpr int kReaderGone = 141;

struct Command {
  Verb verb;
  std::string_view name;
  std::string_view arguments;  ///< as help shows them
  std::string_view help;       ///< one sentence, no full stop
  bool writes;                 ///< ends with a line that says what was written, or why nothing was
  /// Returns the exit code. Throws Error.
  int (*run)(const Arguments&, const Console&);
  /// The exit code when something goes wrong, if the command's codes are its own; else it is the Fault.
  int (*failed)(const Arguments&) = nullptr;
  std::string_view output = {};  ///< what -o names, if the command has it; no full stop
};

/// In the order of Verb.
std::span<const Command> commands();
const Command& commandOf(Verb verb);
/// "render, info".
std::string namesOf(Verbs verbs);

/// The whole program, without the name it was called by. Returns the exit code; throws nothing.
int run(const std::vector<std::string>& words);

/// Says that memory does not suffice; `doing`, if any, follows on "while". `file`, if any, is what was worked
/// on.
Error outOfMemory(const std::string& doing, const std::string& file = {});

/// Throws Error(Fault::usage) if both are names of one file: what is read is not written over. The files that
/// a scene is made of are known once it is read: checkIsNoInput().
void checkDistinct(const std::string& read, const std::string& written);

/// The files that scenes may read besides their own folders: those of the command line.
std::vector<std::string> allowedFiles(const Arguments& arguments);

/// The context of most commands that print facts.
inline constexpr std::array<std::string_view, 2> kTextOrJson{"text", "json"};
/// --format, or the first of those the command knows. Throws Error(Fault::usage) for another.
std::string_view chosenFormat(const Arguments& arguments, std::string_view command,
                              std::span<const std::string_view> known);

/// The file of the studio's program, which lies beside this one; "" if it was not built.
std::string studioProgram();
/// It was built, and there is a display.
bool opensWindows();
/// Says which of the two is missing, and what to do.
Error noWindow();

// The functions of the table; each in its own file.
int renderCommand(const Arguments& arguments, const Console& console);
int infoCommand(const Arguments& arguments, const Console& console);
int benchCommand(const Arguments& arguments, const Console& console);
int explainCommand(const Arguments& arguments, const Console& console);
int lintCommand(const Arguments& arguments, const Console& console);
int diffCommand(const Arguments& arguments, const Console& console);
int gradeCommand(const Arguments& arguments, const Console& console);
int failedDiff(const Arguments& arguments);
int convertCommand(const Arguments& arguments, const Console& console);
int textureCommand(const Arguments& arguments, const Console& console);
int materialsCommand(const Arguments& arguments, const Console& console);
int newCommand(const Arguments& arguments, const Console& console);
int formatCommand(const Arguments& arguments, const Console& console);
int expandCommand(const Arguments& arguments, const Console& console);
int stereogramCommand(const Arguments& arguments, const Console& console);
int splitCommand(const Arguments& arguments, const Console& console);
int farmCommand(const Arguments& arguments, const Console& console);
int mergeCommand(const Arguments& arguments, const Console& console);
int featuresCommand(const Arguments& arguments, const Console& console);
int selftestCommand(const Arguments& arguments, const Console& console);
int guiCommand(const Arguments& arguments, const Console& console);

}  // namespace trace::cli
