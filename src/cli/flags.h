// THE table of the program's own flags: those that are no options of a render (scene/options.h). It drives
// parsing, help and docs/options.md.
#pragma once

#include <span>
#include <string_view>

#include "cli/arguments.h"
#include "scene/short_flags.h"

namespace trace::cli {

struct Flag {
  enum class Takes { nothing, optional, value };

  std::string_view name;  ///< without "--"
  char letter;            ///< short form, or 0
  Takes takes;
  std::string_view values;  ///< what it takes, as help shows it
  std::string_view alone;   ///< Takes::optional: the value that `--name` by itself stands for
  Verbs commands;           ///< the sub-commands that know it
  bool common;              ///< on the one screen of `--help`
  std::string_view help;    ///< one sentence, no full stop
  /// Throws Error(Fault::usage).
  void (*apply)(Arguments&, std::string_view value);
};

std::span<const Flag> flags();
/// Whether the flags of the options table belong to the sub-command.
bool takesOptions(Verb command);
/// Whether that option is a flag of the sub-command: limits of time and memory are of every one that works.
bool takesOption(Verb command, const Option& option);

/// The value that --enable gives an option that is not on or off: one with a visible, useful effect. "" if
/// the option cannot be enabled.
std::string_view enabledValue(const Option& option);

}  // namespace trace::cli
