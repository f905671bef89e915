// The light of a clear daylight sky, of a sun and a turbidity: A. J. Preetham, P. Shirley and B. Smits, A
// Practical Analytic Model for Daylight, SIGGRAPH 1999, appendix A.2. Up is +y.
#pragma once

#include "math/color.h"
#include "math/vec.h"

namespace trace {

/// CIE chromaticity and luminance.
struct ColorXyY {
  Real x = 0, y = 0, Y = 0;  ///< Y in kcd/m^2
};

/// Linear Rec. 709 of luminance Y; negative channels, which no screen shows, are 0.
Color toColor(const ColorXyY& color);

class Daylight {
 public:
  static constexpr Real kLeastTurbidity = 1.7, kMostTurbidity = 10;  ///< pure air; haze

  /// `sun`: the direction to it, of any length but 0; one below the horizon counts as on it.
  Daylight(Real turbidity, const Vec3& sun);

  const ColorXyY& zenith() const { return zenith_; }
  /// The colour in a direction of length 1; below the horizon, that of the horizon above it.
  ColorXyY at(const Vec3& direction) const;

 private:
  struct Perez {
    Real a, b, c, d, e;
    Real at(Real cosTheta, Real gamma) const;
  };

  Vec3 sun_;         // direction of length 1, not below the horizon
  Real sunFromTop_;  // theta_s
  ColorXyY zenith_;
  Perez Y_, x_, y_;
};

}  // namespace trace
