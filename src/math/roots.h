// Roots of polynomials.
#pragma once

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

}  // namespace trace
