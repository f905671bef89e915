// Levels from colours and back: see tone.h. Sits between the finished Picture and the codecs.
// Source: the value formulas of the courses' skeletons (truncate) and the usual rounding (nearest).
// The comparison in toLevel is written so that a NaN fails it and becomes black.
#include "image/development/tone.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/budget.h"

namespace trace {

ValueRange finiteRange(const Picture& picture) {
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  ValueRange range{kBeyond, -kBeyond};
  for (const Color& c : picture.pixels) {
    checkBudget();
    for (double channel : {c.r, c.g, c.b}) {
      if (!std::isfinite(channel)) continue;
      range.low = std::min(range.low, channel);
      range.high = std::max(range.high, channel);
    }
  }
  return range.low <= range.high ? range : ValueRange{};
}

Picture stretched(Picture picture, const ValueRange& range) {
  const double extent = range.high - range.low;
  if (!(extent > 0)) return picture;
  const auto stretch = [&](double c) { return (c - range.low) / extent; };
  for (Color& c : picture.pixels) {
    checkBudget();
    c = {stretch(c.r), stretch(c.g), stretch(c.b)};
  }
  return picture;
}

Picture toned(Picture picture, Tone tone) {
  if (tone != Tone::stretch) return picture;
  const ValueRange range = finiteRange(picture);
  return stretched(std::move(picture), range);
}

std::uint8_t toLevel(double c, Rounding rounding) {
  if (!(c > 0)) return 0;
  if (c >= 1) return 255;
  return static_cast<std::uint8_t>(255 * c + (rounding == Rounding::nearest ? 0.5 : 0.0));
}

Bytes toBytes(const Picture& picture, Rounding rounding) {
  return toBytes(picture, rounding, [](const Color& c) { return c; });
}

Picture fromBytes(const Bytes& bytes) {
  Picture picture(bytes.width, bytes.height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const std::uint8_t* rgb = &bytes.rgb[3 * i];
    picture.pixels[i] = {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
  }
  return picture;
}

}  // namespace trace
