// Text about the program itself, made from the tables: options, flags, sub-commands, formats.
#pragma once

#include <string>

namespace trace::cli {

/// The common flags on one screen, or with `all` every flag with range, default and source.
std::string helpText(bool all);

struct Command;
/// The page of one sub-command: what it does and its flags.
std::string helpText(const Command& command, bool all);

/// A few lines for someone who typed `ray` alone and nothing more.
std::string briefHelp();

/// Every option as name=value, a line each.
std::string defaultsText();

/// The file docs/options.md.
std::string optionsMarkdown();

}  // namespace trace::cli
