#include "cli/terminal/console.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

#include "base/printable.h"
#include "base/text.h"
#include "cli/terminal/terminal.h"

namespace trace::cli {
namespace {

constexpr std::string_view kLevels[] = {"error", "warning", "info", "debug"};

/// The word "error:" or "warning:" of a message in bold red or yellow.
std::string colored(const Message& message) {
  std::string text = toString(message);
  const bool error = message.severity == Message::Severity::error;
  const std::string word = error ? "error:" : "warning:";
  // The name of the file, which comes first, may hold that word as well.
  const size_t at = text.find(word, printable(message.place.file.str()).size());
  if (at == std::string::npos) return text;
  text.insert(at + word.size(), "\033[0m");
  text.insert(at, error ? "\033[1;31m" : "\033[1;33m");
  return text;
}

/// A line that may be drawn on stderr by a thread that watches, until another prints.
std::mutex drawnLine;
bool lineIsDrawn = false;

void replaceDrawnLine(const std::string& text, bool draws) {
  const std::lock_guard lock(drawnLine);
  if (std::exchange(lineIsDrawn, draws)) std::fputs("\r\033[K", stderr);
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

void printToTerminal(const std::string& text) { replaceDrawnLine(text, false); }
void drawOnTerminal(const std::string& line) { replaceDrawnLine("\r" + line + "\r", true); }
void clearDrawnLine() { replaceDrawnLine("", false); }

LogLevel logLevel(std::string_view who, std::string_view name) {
  const auto found = std::find(std::begin(kLevels), std::end(kLevels), name);
  if (found == std::end(kLevels))
    throw Error(
        Fault::usage,
        std::string(who) + ": expected error | warning | info | debug, found \"" + std::string(name) + "\"",
        didYouMean(name, kLevels));
  return static_cast<LogLevel>(found - std::begin(kLevels));
}

Console::Console(LogLevel level, bool quiet) : level_(level), quiet_(quiet), color_(canColor()) {}

void Console::print(std::span<const Message> messages, std::string_view kind) const {
  for (const Message& message : messages.first(std::min(messages.size(), kMostMessages)))
    printToTerminal(color_ ? colored(message) : toString(message));
  if (messages.size() > kMostMessages)
    printToTerminal("... and " + counted(messages.size() - kMostMessages, "more " + std::string(kind)) +
                    "\n");
}

void Console::warnings(std::span<const Message> messages) const {
  if (!shows(LogLevel::warning)) return;
  std::vector<Message> sorted(messages.begin(), messages.end());
  // In the order of each file, and last what concerns all of it.
  std::stable_sort(sorted.begin(), sorted.end(), [](const Message& a, const Message& b) {
    const auto key = [](const SourcePlace& p) { return std::pair(p.line > 0 ? p.line : INT_MAX, p.column); };
    return std::pair(a.place.file, key(a.place)) < std::pair(b.place.file, key(b.place));
  });
  print(sorted, "warning");
}

void Console::error(const Error& error) const {
  print(error.messages(), "error");
  if (error.messages().size() == Messages::kMostErrors)
    printToTerminal("... and perhaps more: reading ends at the " + std::to_string(Messages::kMostErrors) +
                    "th error\n");
}

void Console::line(LogLevel importance, const std::string& text) const {
  if (importance == LogLevel::error || shows(importance)) printToTerminal(printable(text) + "\n");
}

void Console::lines(LogLevel importance, const std::string& text) const {
  if (importance == LogLevel::error || shows(importance))
    printToTerminal(printable(text, LineEnds::kept) + "\n");
}

void Console::last(bool well, const std::string& text) const {
  if (!well || !quiet_) printToTerminal(printable(text) + "\n");
}

namespace {

void writeToStdout(const std::string& shown) {
  errno = 0;
  std::fwrite(shown.data(), 1, shown.size(), stdout);
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout);
  if (failed && errno == EPIPE) throw ReaderGone{};
  if (failed)
    throw Error(Fault::io, std::string("cannot write to the standard output: ") + std::strerror(errno));
}

}  // namespace

void printResult(const std::string& text, Paint paint) {
  writeToStdout(paint == Paint::none ? printable(text, LineEnds::kept) : text);
}

void printFile(const std::string& bytes) { writeToStdout(bytes); }

}  // namespace trace::cli
