// Output for people on stderr: messages, by their importance, and the last line. Results go to stdout, not
// through here.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text.h"

namespace trace::cli {

enum class LogLevel { error, warning, info, debug };

/// Throws Error(Fault::usage) that names `who` asked.
LogLevel logLevel(std::string_view who, std::string_view name);

class Console {
 public:
  /// More messages than this are only counted.
  static constexpr std::size_t kMostMessages = 20;

  /// Quiet: without last() where all went well.
  explicit Console(LogLevel level = LogLevel::info, bool quiet = false);

  bool shows(LogLevel level) const { return level <= level_; }

  /// Warnings, if the level shows them; of more than kMostMessages the rest is counted.
  void warnings(std::span<const Message> messages) const;
  /// The messages of an error, as many as warnings().
  void error(const Error& error) const;
  /// One line of text without its end, if the level shows it; an importance of error is always shown.
  void line(LogLevel importance, const std::string& text) const;
  /// The last line of a command, which did what it was asked for (`well`) or did not. Shown at every level.
  void last(bool well, const std::string& text) const;
  /// Writes text of several lines.
  void lines(LogLevel importance, const std::string& text) const;

 private:
  void print(std::span<const Message> messages, std::string_view kind) const;

  LogLevel level_;
  bool quiet_;
  bool color_;
};

/// Thrown when nobody reads the results any more, as in `ray features | head -1`.
struct ReaderGone {};

/// Characters of a result that are neither letters nor line ends: nothing that a terminal obeys, or colours
/// that the program put there, around names that are printable().
enum class Paint { none, colors };

/// Writes to stdout. Throws Error(Fault::io) when that fails, as on a full disk, or ReaderGone.
void printResult(const std::string& text, Paint paint = Paint::none);
/// Writes the bytes of a file to stdout, likewise.
void printFile(const std::string& bytes);

/// Writes to stderr, at once, in place of a drawn line.
void printToTerminal(const std::string& text);
/// Draws a line on stderr, which whatever is drawn or printed next replaces.
void drawOnTerminal(const std::string& line);
void clearDrawnLine();

}  // namespace trace::cli
