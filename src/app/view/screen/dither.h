// Noise of less than one level of 255, added before colours are rounded to bytes: a shade that changes slowly
// has no visible bands then. Interleaved gradient noise (Jimenez, "Next generation post processing in Call of
// Duty: Advanced Warfare", 2014): neighbouring pixels get values that are spread evenly.
#pragma once

#include <cmath>

namespace trace {

/// In levels, from -0.5 to 0.5, for a pixel of the picture; each step of a mean of several pictures has its
/// own.
inline double ditherAt(double x, double y, int step) {
  constexpr double kApart = 5.588238;  // pixels from one step to the next
  const auto fraction = [](double v) { return v - std::floor(v); };
  const double along = 0.06711056 * (x + kApart * step) + 0.00583715 * (y + kApart * step);
  return fraction(52.9829189 * fraction(along)) - 0.5;
}

}  // namespace trace
