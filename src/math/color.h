// Linear Rec. 709 colour.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace trace {

struct Color {
  double r = 0, g = 0, b = 0;

  constexpr Color() = default;
  constexpr explicit Color(double grey) : r(grey), g(grey), b(grey) {}
  constexpr Color(double r_, double g_, double b_) : r(r_), g(g_), b(b_) {}
  constexpr bool operator==(const Color&) const = default;
};

constexpr Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Color operator*(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Color operator*(const Color& c, double s) { return {c.r * s, c.g * s, c.b * s}; }
constexpr Color operator*(double s, const Color& c) { return c * s; }
constexpr Color operator/(const Color& c, double s) { return {c.r / s, c.g / s, c.b / s}; }
constexpr Color& operator+=(Color& a, const Color& b) { return a = a + b; }
constexpr Color& operator*=(Color& a, const Color& b) { return a = a * b; }

constexpr bool isBlack(const Color& c) { return c.r == 0 && c.g == 0 && c.b == 0; }
inline bool isFinite(const Color& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}
constexpr double maxComponent(const Color& c) { return std::max(c.r, std::max(c.g, c.b)); }
/// Each channel raised to the power: kt^distance of an absorbing medium.
inline Color pow(const Color& c, double e) {
  return {math::pow(c.r, e), math::pow(c.g, e), math::pow(c.b, e)};
}
constexpr Color lerp(double t, const Color& a, const Color& b) { return a * (1 - t) + b * t; }
inline Color clamp01(const Color& c) {
  return {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
}

}  // namespace trace
