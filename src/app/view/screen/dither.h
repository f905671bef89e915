// Noise of less than one level of 255, added before colours are rounded to bytes: a shade that changes slowly
// has no visible bands then. Interleaved gradient noise (Jimenez, "Next generation post processing in Call of
// Duty: Advanced Warfare", 2014): neighbouring pixels get values that are spread evenly.
#pragma once

#include <cmath>

namespace trace {

/// The numbers of the noise, which shaders take from here.
struct Dither {
  static constexpr double kTurns = 52.9829189, kAcross = 0.06711056, kDown = 0.00583715;
  static constexpr double kApart = 5.588238;  ///< pixels from one step to the next
};

/// In levels, from -0.5 to 0.5, for a pixel of the picture; each step of a mean of several pictures has its
/// own.
inline double ditherAt(double x, double y, int step) {
  const auto fraction = [](double v) { return v - std::floor(v); };
  const double away = Dither::kApart * step;
  const double along = Dither::kAcross * (x + away) + Dither::kDown * (y + away);
  return fraction(Dither::kTurns * fraction(along)) - 0.5;
}

}  // namespace trace
