// The short flags of the command line that stand for options.
#pragma once

#include <span>
#include <string_view>

#include "scene/options.h"

namespace trace {

/// The courses' short flags that stand for options: `-w 400` is `--width 400`, `-b` is `--accel bvh`.
struct ShortFlag {
  char letter;
  std::string_view option;
  std::string_view value;  ///< "" when the user gives it
  std::string_view help;
};
std::span<const ShortFlag> shortFlags();

/// The meaning of the flag -b of the courses' line, besides its option: one ray a pixel, and no early stop
/// that the scene asks for. These come before the flags of the line, which therefore win wherever they stand.
inline constexpr char kPlainFlag = 'b';
std::span<const Choice> plainChoices();

/// A word that may stand after the flag of an option that is on or off, and may be left out there.
bool isSwitch(std::string_view word);

}  // namespace trace
