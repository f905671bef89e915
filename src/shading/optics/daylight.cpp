#include "shading/optics/daylight.h"

#include <algorithm>

#include "math/elementary.h"

namespace trace {
namespace {

/// A cubic in the sun's angle from the zenith for each power of the turbidity, T^2, T and 1.
struct Chromaticity {
  Real k[3][4];
  Real at(Real T, Real s) const {
    const auto cubic = [s](const Real(&c)[4]) { return ((c[0] * s + c[1]) * s + c[2]) * s + c[3]; };
    return (cubic(k[0]) * T + cubic(k[1])) * T + cubic(k[2]);
  }
};
constexpr Chromaticity kZenithX{{{0.00166, -0.00375, 0.00209, 0},
                                 {-0.02903, 0.06377, -0.03202, 0.00394},
                                 {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr Chromaticity kZenithY{{{0.00275, -0.00610, 0.00317, 0},
                                 {-0.04214, 0.08970, -0.04153, 0.00516},
                                 {0.15346, -0.26756, 0.06670, 0.26688}}};

ColorXyY zenithOf(Real T, Real s) {
  const Real chi = (4.0 / 9 - T / 120) * (kPi - 2 * s);
  const Real luminance = (4.0453 * T - 4.9710) * math::tan(chi) - 0.2155 * T + 2.4192;
  return {kZenithX.at(T, s), kZenithY.at(T, s), std::max(luminance, 0.0)};
}

}  // namespace

Color toColor(const ColorXyY& c) {
  if (!(c.y > 0)) return Color(0);
  const Real X = c.x / c.y * c.Y, Y = c.Y, Z = (1 - c.x - c.y) / c.y * c.Y;
  // Rec. 709's primaries and white D65 (IEC 61966-2-1).
  const Color color(3.2406 * X - 1.5372 * Y - 0.4986 * Z, -0.9689 * X + 1.8758 * Y + 0.0415 * Z,
                    0.0557 * X - 0.2040 * Y + 1.0570 * Z);
  return {std::max(color.r, 0.0), std::max(color.g, 0.0), std::max(color.b, 0.0)};
}

/// Perez' sky: darker or brighter toward the horizon (a, b), brighter around the sun (c, d, e).
Real Daylight::Perez::at(Real cosTheta, Real gamma) const {
  const Real toHorizon = cosTheta > 0 ? math::exp(b / cosTheta) : 0;
  const Real cosGamma = math::cos(gamma);
  return (1 + a * toHorizon) * (1 + c * math::exp(d * gamma) + e * cosGamma * cosGamma);
}

Daylight::Daylight(Real turbidity, const Vec3& sun) {
  const Vec3 risen{sun.x, std::max(sun.y, 0.0), sun.z};
  sun_ = length(risen) > 0 ? normalize(risen) : Vec3{0, 0, -1};  // one straight below says no direction
  sunFromTop_ = math::atan2(math::hypot(sun_.x, sun_.z), sun_.y);
  const Real T = std::clamp(turbidity, kLeastTurbidity, kMostTurbidity);
  zenith_ = zenithOf(T, sunFromTop_);
  Y_ = {0.1787 * T - 1.4630, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251, 0.1206 * T - 2.5771,
        -0.0670 * T + 0.3703};
  x_ = {-0.0193 * T - 0.2592, -0.0665 * T + 0.0008, -0.0004 * T + 0.2125, -0.0641 * T - 0.8989,
        -0.0033 * T + 0.0452};
  y_ = {-0.0167 * T - 0.2608, -0.0950 * T + 0.0092, -0.0079 * T + 0.2102, -0.0441 * T - 1.6537,
        -0.0109 * T + 0.0529};
}

ColorXyY Daylight::at(const Vec3& direction) const {
  const Real cosTheta = std::max(direction.y, 0.0);
  const Vec3 d = direction.y >= 0 ? direction : Vec3{direction.x, 0, direction.z};
  const Real across = length(d);
  const Real gamma = across > 0 ? math::acos(std::clamp(dot(d, sun_) / across, -1.0, 1.0)) : sunFromTop_;
  const auto relative = [&](const Perez& f) { return f.at(cosTheta, gamma) / f.at(1, sunFromTop_); };
  return {zenith_.x * relative(x_), zenith_.y * relative(y_), zenith_.Y * relative(Y_)};
}

}  // namespace trace
