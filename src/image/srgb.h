// The transfer function and the luminance of sRGB, which screens expect and most picture files hold (IEC
// 61966-2-1).
#pragma once

#include <algorithm>

#include "math/color.h"
#include "math/elementary.h"

namespace trace {

/// The linear value of an sRGB one, both from 0 to 1.
inline double linearOfSrgb(double value) {
  return value <= 0.04045 ? value / 12.92 : math::pow((value + 0.055) / 1.055, 2.4);
}

/// The inverse. What is beyond 0 to 1, or no number, is cut off.
inline double srgbOfLinear(double value) {
  if (!(value > 0)) return 0;
  return value <= 0.0031308 ? 12.92 * value : 1.055 * math::pow(std::min(value, 1.0), 1 / 2.4) - 0.055;
}

/// The luminance of linear Rec. 709 colours, whose primaries and white sRGB has.
constexpr double luminanceOf(const Color& c) { return 0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b; }

}  // namespace trace
