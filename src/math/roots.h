// Roots of functions of one variable: quadratics in closed form, polynomials of any degree by isolation, and
// the bracketed Newton iteration that ends every search.
//
// Everything here decides by signs. A root is where a function goes from negative to not negative or back, so
// that along a line roots alternate between entries and exits, whatever rounding does; a double root without
// a change of sign is none. There are no tolerances: a search ends where the numbers do.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "math/vec.h"

namespace trace {

struct Roots2 {
  int count = 0;        ///< 0 or 2 (a double root is given twice)
  Real t0 = 0, t1 = 0;  ///< t0 <= t1
};

/// The real roots of a t^2 + 2 b t + c for a != 0, without cancellation (Numerical Recipes, 5.6).
/// `quarterDiscriminant` is b^2 - a c, which the caller may know more exactly than by that formula.
inline Roots2 solveQuadratic(Real a, Real b, Real c, Real quarterDiscriminant) {
  if (!(quarterDiscriminant >= 0)) return {};
  const Real q = -(b + std::copysign(std::sqrt(quarterDiscriminant), b));
  Real t0 = q / a;
  Real t1 = q == 0 ? t0 : c / q;
  if (t1 < t0) std::swap(t0, t1);
  return {2, t0, t1};
}

/// A function's value at a place, and its derivative there.
struct Jet {
  Real value = 0, slope = 0;
};

/// Where f changes sign in [a, b]: f(t) returns a Jet, and is negative at one end only, which is a if
/// `negativeAtA`. Newton's steps from `guess` while they stay in the bracket and shrink, else halving.
template <class F>
Real rootBetween(F&& f, Real a, Real b, bool negativeAtA, Real guess) {
  constexpr int kMost = 200;  // halving alone needs fewer for any two numbers of like size
  Real t = a < guess && guess < b ? guess : a + 0.5 * (b - a), lastStep = b - a;
  for (int i = 0; i < kMost && a < t && t < b; ++i) {
    const Jet at = f(t);
    ((at.value < 0) == negativeAtA ? a : b) = t;
    Real next = t - at.value / at.slope;
    if (!(next >= a && next <= b && std::abs(next - t) < 0.5 * lastStep)) next = a + 0.5 * (b - a);
    lastStep = std::abs(next - t);
    if (next == t) break;
    t = next;
  }
  return t;
}
template <class F>
Real rootBetween(F&& f, Real a, Real b, bool negativeAtA) {
  return rootBetween(f, a, b, negativeAtA, a + 0.5 * (b - a));
}

/// A walk over ascending places of a line, between neighbours of which a function changes sign once at most.
/// It finds each change: of a polynomial between its extrema, or of any function between places where it is
/// known to rise or fall only.
struct SignWalk {
  Real at = 0;            ///< where the walk has come
  bool negative = false;  ///< the function's sign there

  /// Continues to t, where the sign is known. If it is another, calls visit(root, negativeBefore);
  /// root(a, b, negativeAtA) finds the place, unless the walk does not move.
  template <class Root, class Visit>
  void to(Real t, bool negativeAtT, Root&& root, Visit&& visit) {
    if (negativeAtT != negative) visit(at < t ? root(at, t, negative) : t, negative);
    at = t;
    negative = negativeAtT;
  }

  /// Continues to t by the signs of f, which returns a Jet. Where 0 lies between, it is looked at too: on
  /// which side of a surface a ray starts is decided at its very origin.
  template <class F, class Visit>
  void to(Real t, F&& f, Visit&& visit) {
    const auto root = [&](Real a, Real b, bool negativeAtA) { return rootBetween(f, a, b, negativeAtA); };
    if (at < 0 && 0 < t) to(0, f(0).value < 0, root, visit);
    to(t, f(t).value < 0, root, visit);
  }
};

/// The polynomial with `coefficients`, that of t^0 first.
inline Jet evaluate(std::span<const Real> coefficients, Real t) {
  Jet at;
  for (std::size_t i = coefficients.size(); i-- > 0;) {
    at.slope = at.slope * t + at.value;
    at.value = at.value * t + coefficients[i];
  }
  return at;
}

inline constexpr std::size_t kMostDegree = 12;

/// Ascending numbers, and room for the ends of an interval around the roots of a polynomial.
struct Nodes {
  std::array<Real, kMostDegree + 3> at;  // not set before it is used: this is met for every ray
  std::size_t count = 0;

  void add(Real t) { at[count++] = t; }
  operator std::span<const Real>() const { return {at.data(), count}; }
};

/// a, the places in (a, b) where the polynomial changes sign, and b. Isolated by the signs of Bernstein
/// ordinates (Lane and Riesenfeld, Bounds on a Polynomial, 1981): no change, no root; one change, one root;
/// of several the interval is halved, until they are no more than rounding. The degree is at most
/// kMostDegree; leading coefficients may be zero.
Nodes rootsWithEnds(std::span<const Real> coefficients, Real a, Real b);

/// How often the sign changes among those ordinates over [a, b]: at least as often as that of the polynomial
/// does. 2 if rounding hides it.
int signVariations(std::span<const Real> coefficients, Real a, Real b);

/// a, the places in (a, b) where the polynomial's derivative changes sign, and b: places for a SignWalk.
inline Nodes extremaWithEnds(std::span<const Real> coefficients, Real a, Real b) {
  Real derivative[kMostDegree];
  for (std::size_t i = 1; i < coefficients.size(); ++i)
    derivative[i - 1] = static_cast<Real>(i) * coefficients[i];
  return rootsWithEnds({derivative, coefficients.size() - 1}, a, b);
}

}  // namespace trace
