// The root of a function that takes long, whose place is nearly known from a simpler one.
#pragma once

#include "math/roots.h"

namespace trace {

/// rootBetween() where a root is expected at `guess`. Close to it Newton's steps are rounding and leave one
/// end of the bracket far off; so both ends are brought there first: the guess, and twice the step from it.
template <class F>
Real rootNear(F&& f, Real a, Real b, bool negativeAtA, Real guess) {
  if (!(a < guess && guess < b)) return rootBetween(f, a, b, negativeAtA);
  const Jet at = f(guess);
  const bool before = (at.value < 0) == negativeAtA;
  const Real step = max(std::abs(2 * at.value / at.slope), std::ldexp(std::abs(guess), -50));
  (before ? a : b) = guess;
  const Real other = before ? guess + step : guess - step;
  if (a < other && other < b && ((f(other).value < 0) == negativeAtA) != before) (before ? b : a) = other;
  return rootBetween(f, a, b, negativeAtA);
}

}  // namespace trace
