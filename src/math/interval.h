// Interval arithmetic (Moore 1966): the result of an operation on intervals holds the results for all numbers
// in them, rounding included. What a function is over a stretch of a ray, without missing anything.
#pragma once

#include <algorithm>

#include "math/elementary.h"
#include "math/vec.h"

namespace trace {

/// low <= high. An operation that is undefined somewhere gives what it can be elsewhere, or everything.
struct Interval {
  Real low, high;

  Interval() = default;                                        // leaves them as they are, for large arrays
  constexpr Interval(Real value) : low(value), high(value) {}  // NOLINT(google-explicit-constructor)
  constexpr Interval(Real l, Real h) : low(l), high(h) {}
  static constexpr Interval everything() { return {-kInfinity, kInfinity}; }

  bool contains(Real x) const { return low <= x && x <= high; }
};

/// Widened by more than the rounding of a few operations; everything if it is no number.
inline Interval outward(Real low, Real high) {
  constexpr Real kMore = 4 * std::numeric_limits<Real>::epsilon(), kLeast = std::numeric_limits<Real>::min();
  if (!(low <= high)) return Interval::everything();
  return {low - (std::abs(low) * kMore + kLeast), high + (std::abs(high) * kMore + kLeast)};
}

inline Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
inline Interval operator+(const Interval& a, const Interval& b) {
  return outward(a.low + b.low, a.high + b.high);
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return outward(a.low - b.high, a.high - b.low);
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const Real p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  if (!(std::isfinite(p) && std::isfinite(q) && std::isfinite(r) && std::isfinite(s)))
    return Interval::everything();
  return outward(min(min(p, q), min(r, s)), max(max(p, q), max(r, s)));
}
inline Interval operator/(const Interval& a, const Interval& b) {
  if (b.contains(0)) return Interval::everything();
  return a * outward(1 / b.high, 1 / b.low);
}
inline Interval min(const Interval& a, const Interval& b) { return {min(a.low, b.low), min(a.high, b.high)}; }
inline Interval max(const Interval& a, const Interval& b) { return {max(a.low, b.low), max(a.high, b.high)}; }
/// The smallest that holds both.
inline Interval hull(const Interval& a, const Interval& b) {
  return {min(a.low, b.low), max(a.high, b.high)};
}

inline Interval abs(const Interval& a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return -a;
  return {0, max(-a.low, a.high)};
}
inline Interval square(const Interval& a) {
  const Interval b = abs(a);
  const Interval s = outward(b.low * b.low, b.high * b.high);
  return {max(s.low, 0), s.high};
}
/// The root of the part of it that is not negative.
inline Interval sqrt(const Interval& a) {
  if (!(a.high >= 0)) return Interval::everything();
  const Interval s = outward(std::sqrt(max(a.low, 0)), std::sqrt(a.high));
  return {max(s.low, 0), s.high};
}
inline Interval exp(const Interval& a) {
  const Interval e = outward(math::exp(a.low), math::exp(a.high));
  return {max(e.low, 0), e.high};
}
/// The logarithm of the part of it that is positive.
inline Interval log(const Interval& a) {
  if (!(a.high > 0)) return Interval::everything();
  return outward(a.low > 0 ? math::log(a.low) : -kInfinity, math::log(a.high));
}
inline Interval sin(const Interval& a) {
  // Between neighbouring extrema the sine is monotone; far out, where doubles are coarse, it is anything.
  if (!(a.high - a.low < 2 * kPi && std::abs(a.low) < 1e9)) return {-1, 1};
  const Real s = math::sin(a.low), t = math::sin(a.high);
  Interval r = outward(min(s, t), max(s, t));
  constexpr Real kSlack = 1e-6;  // extrema this near are taken to be inside: always safe
  const auto holds = [&](Real extremum) {
    const Real k = std::ceil((a.low - kSlack - extremum) / (2 * kPi));
    return extremum + 2 * kPi * k <= a.high + kSlack;
  };
  if (holds(kPi / 2)) r.high = 1;
  if (holds(-kPi / 2)) r.low = -1;
  return {max(r.low, -1), min(r.high, 1)};
}
inline Interval cos(const Interval& a) { return sin(outward(a.low + kPi / 2, a.high + kPi / 2)); }
/// a^n for a whole number n >= 0.
inline Interval power(const Interval& a, int n) {
  if (n == 0) return 1;
  const Interval b = n % 2 == 0 ? abs(a) : a;
  const auto raised = [n](Real x) { return n == 3 ? x * x * x : n == 4 ? x * x * (x * x) : math::pow(x, n); };
  Interval r = n == 1 ? a : outward(raised(b.low), raised(b.high));
  if (n % 2 == 0) r.low = max(r.low, 0);
  return r;
}
/// a^e for a >= 0.
inline Interval power(const Interval& a, Real e) {
  const Real low = max(a.low, 0);
  if (!(a.high >= 0) || (e < 0 && low == 0)) return Interval::everything();
  const Real p = math::pow(low, e), q = math::pow(a.high, e);
  const Interval r = outward(min(p, q), max(p, q));
  return {max(r.low, 0), r.high};
}

}  // namespace trace
