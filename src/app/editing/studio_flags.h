// THE table of ray-studio's own flags; the others are those of the options table. It drives the parser of the
// studio, its help, its manual page and the completions.
#pragma once

#include <array>
#include <string_view>

namespace trace {

struct StudioFlag {
  std::string_view name;   ///< without "--"
  char letter;             ///< short form, or 0
  std::string_view value;  ///< what it takes, as help shows it; "" for nothing
  std::string_view help;   ///< one sentence, no full stop
};

inline constexpr std::array kStudioFlags{
    StudioFlag{"reference", 0, "PICTURE", "a picture to compare with"},
    StudioFlag{"pixel", 0, "X,Y", "a pixel of the scene's picture to be clicked, counted from the top left"},
    StudioFlag{"window", 0, "WIDTHxHEIGHT", "size of the window; 1280x800 at first, then as it was left"},
    StudioFlag{"allow-read", 0, "DIR", "also let scenes read the files below this folder"},
    StudioFlag{"script", 0, "FILE", "do what the file says, one command a line, then close the window"},
    StudioFlag{"help", 'h', "", "print the flags and the commands of a script"},
    StudioFlag{"version", 0, "", "print the version"},
};

/// Whether the studio has a flag of that name that takes a value.
constexpr bool isStudioValue(std::string_view name) {
  for (const StudioFlag& flag : kStudioFlags)
    if (flag.name == name) return !flag.value.empty();
  return false;
}

}  // namespace trace
