// Completions of shells for `ray`, `trace-ray` and `ray-studio`: what may stand after each flag and where no
// flag stands, from the tables of commands, flags and options, and the scripts for bash, zsh and fish made of
// it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands/commands.h"
#include "cli/flags.h"

namespace trace::cli {

/// The words that may stand in one place of the command line.
struct Candidates {
  enum class Kind {
    none,      ///< nothing: the flag takes no value
    anything,  ///< a value that no list holds, such as a number
    words,
    list,   ///< words with commas between
    files,  ///< those with one of `suffixes`, or any if there are none
    folders
  };
  Kind kind = Kind::none;
  std::vector<std::string> words{};     ///< also of files: words that may stand in their place
  std::vector<std::string> suffixes{};  ///< lower case with the dot
};

/// One flag in all its spellings.
struct FlagFace {
  std::vector<std::string> names;  ///< "-w", "--width"
  std::string help;                ///< one sentence, no full stop
  std::string value;               ///< as help shows it
  bool optional = false;           ///< the value may be left out
  Candidates candidates{};
};

/// Every flag of the sub-command: its own, then those of options.
std::vector<FlagFace> flagFaces(Verb command);
/// Every flag of ray-studio.
std::vector<FlagFace> studioFlagFaces();
/// The words that may stand where no flag does.
Candidates operands(Verb command);
/// Scenes and meshes by their suffixes, compressed ones too.
Candidates sceneFiles();

inline constexpr std::array<std::string_view, 3> kShells{"bash", "zsh", "fish"};
/// The script for the shell. Precondition: one of kShells.
std::string completionScript(std::string_view shell);

}  // namespace trace::cli
