// Pieces of text about options, flags and commands, from which help, docs/options.md, the manual pages and
// the completions of shells are put together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/commands/commands.h"
#include "cli/flags.h"

namespace trace::cli {

/// The value of an option as its help shows it: "N", "bvh|none".
std::string placeholder(const Option& option);
/// "1 to 65536 rays"; of an enumeration its names.
std::string rangeText(const Option& option);
std::string defaultOf(const Option& option);
/// The short flags that stand for a value of the option: "-b is bvh, -B is none".
std::string shortValues(const Option& option);

/// "-w, --width".
std::string flagsOf(const Option& option);
/// "-o, --output FILE".
std::string flagsOf(const Flag& flag);

/// The groups of options, in the order of their table.
std::vector<std::string_view> optionGroups();

/// "ray explain SCENE --pixel X,Y".
std::string usageOf(const Command& command);

/// Sentences without the full stop of the last.
std::string_view exitCodes();
std::string_view signalsText();

}  // namespace trace::cli
