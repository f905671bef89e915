// From linear colours to the 8-bit levels of a picture file, and back.
//
// The last step of a picture's life before codec or screen. No gamma is applied: the courses' programs
// write linear values as they are, and so their published pictures compare. The two roundings are the
// two found in those programs: (int)(255*c) in the skeletons, (int)(255*c + 0.5) elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "image/picture.h"

namespace trace {

enum class Rounding { truncate, nearest };

/// Levels 0 to 255: three per pixel, r g b; row 0 at the top.
struct Bytes {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  bool operator==(const Bytes&) const = default;
};

/// The level of one channel: c clamped to [0,1], times 255, rounded. NaN gives 0.
std::uint8_t toLevel(double c, Rounding rounding);

/// The levels of a whole picture. Never fails.
Bytes toBytes(const Picture& picture, Rounding rounding);

/// Level / 255. toBytes() of the result gives the same levels, with either rounding.
Picture fromBytes(const Bytes& bytes);

}  // namespace trace
