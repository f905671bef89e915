// From linear colours to the 8-bit levels of a picture file, and back.
//
// The last step of a picture's life before codec or screen. No gamma is applied: the courses' programs
// write linear values as they are, and so their published pictures compare. The two tones and the two
// roundings are those found in the programs: most cut off what is beyond [0,1], those of British Columbia
// stretch the picture to it; (int)(255*c) in the skeletons, (int)(255*c + 0.5) elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "base/budget.h"
#include "image/picture.h"

namespace trace {

enum class Tone { clamp, stretch, reinhard, filmic, agx };  // curves: image/development/development.cpp
enum class Rounding { truncate, nearest };

/// Levels 0 to 255: three per pixel, r g b; row 0 at the top.
struct Bytes {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  bool operator==(const Bytes&) const = default;
};

struct ValueRange {
  double low = 0, high = 0;
  bool operator==(const ValueRange&) const = default;
};
/// The range of the finite values of all channels; {0, 0} if there are none.
ValueRange finiteRange(const Picture& picture);

/// (c - low) / (high - low) for every channel; the picture itself if the range is empty.
Picture stretched(Picture picture, const ValueRange& range);

/// The picture stretched by its own finiteRange() if the tone is that; else itself.
Picture toned(Picture picture, Tone tone);

/// The level of one channel: c clamped to [0,1], times 255, rounded. NaN gives 0.
std::uint8_t toLevel(double c, Rounding rounding);

/// The levels of a whole picture whose colours are changed first.
template <class Change>
Bytes toBytes(const Picture& picture, Rounding rounding, const Change& change) {
  Bytes bytes{picture.width, picture.height, {}};
  bytes.rgb.resize(3 * picture.pixels.size());
  std::uint8_t* level = bytes.rgb.data();
  for (const Color& before : picture.pixels) {
    checkBudget();
    const Color c = change(before);
    for (const double channel : {c.r, c.g, c.b}) *level++ = toLevel(channel, rounding);
  }
  return bytes;
}
/// The levels of a whole picture. Never fails.
Bytes toBytes(const Picture& picture, Rounding rounding);

/// Level / 255. toBytes() of the result gives the same levels, with either rounding.
Picture fromBytes(const Bytes& bytes);

}  // namespace trace
