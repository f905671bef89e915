// This process and the machine that it runs on: what each operating system has its own functions for. The
// files of posix/ and of windows/ implement the headers of this folder, base/files/file.h and base/sandbox.h;
// no code outside of this folder asks which system it is compiled for.
//
// Text is UTF-8, and folders in paths are separated by '/', on every system.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trace::os {

/// To be called first in main(). Occupies the places of standard streams that are closed, so that no file or
/// pipe of the program gets one of them and is then written to as if it were stderr; what is written to a
/// closed stdout still fails. A stream whose reader is gone, or a file that has met its limit of size, is an
/// error of writing from now on, and no longer the end of the program. Streams carry bytes, without changing
/// line ends.
void guardStreams();

/// The arguments of main(), without the name of the program. On Windows each '\' in them becomes '/'.
std::vector<std::string> arguments(int argc, char** argv);

/// If this process is alone in the window of a terminal, as after a double click, waits for Enter: the window
/// closes with the process. To be called last in main().
void keepWindowOpen();

/// The value of the variable of the environment; "" when it is unset.
std::string variable(const char* name);

/// The folder that this program lies in; "" if the system does not tell.
std::string ownFolder();
/// The path of a program in the folder, as the system spells programs.
std::string programIn(const std::string& folder, const std::string& name);
/// The text as one word of a POSIX shell, whatever its characters.
inline std::string quotedForShell(std::string_view text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// How a program ended, and what it printed to its standard output and as messages.
struct ProgramAnswer {
  int code = 0;
  std::string text;
};
/// Runs a program to its end: a path, or a name that the system looks for. One that cannot be started answers
/// with a code that is not 0 and the reason.
ProgramAnswer answerOf(const std::vector<std::string>& words);
/// Replaces this program by another, with its arguments. Throws Error(Fault::io) if that fails.
[[noreturn]] void becomeProgram(const std::vector<std::string>& words);

/// Whether a window can be opened.
bool hasDisplay();

/// Writes to stderr, whatever the state of the program, also from within a signal handler.
void say(std::string_view text);
/// ... and ends the process at once.
[[noreturn]] void endAtOnce(std::string_view text, int code);

/// The time that processors have spent on this process, in seconds.
double cpuSeconds();
/// The number of this process, which no other has at the same time.
std::uint64_t processNumber();

}  // namespace trace::os
