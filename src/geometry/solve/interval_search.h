// Every place along a line where a function changes sign, found by interval arithmetic (Mitchell, Robust Ray
// Intersection with Interval Arithmetic, 1990): a stretch over which the function cannot be zero is left out,
// one over which it is monotone is decided by the signs at its ends, any other is halved.
#pragma once

#include <array>

#include "base/budget.h"
#include "geometry/solve/span.h"
#include "math/interval.h"

namespace trace {

/// Calls visit(t, insideBefore) in order along the span for the changes of sign of a function, negative
/// inside, in the range. `bounds`(Interval) gives its value and slope over a stretch, `at`(Real) its Jet.
///
/// Where the function differs from zero by no more than rounding all along a stretch the signs at its ends
/// decide. Nothing hangs: after very many steps they decide about all that is left.
/// `kMostDepth`: how often the span is halved at most.
/// `meanValue`: the value is worth more than its sign, so that the mean value theorem says something.
template <int kMostDepth = 60, bool meanValue = true, class Bounds, class At, class Visit>
void intervalCrossings(const Span& span, const Range& range, Bounds&& bounds, At&& at, Visit&& visit) {
  constexpr int kMostSteps = 20000;
  struct Stretch {
    Real a, b;
    int depth;
  };
  std::array<Stretch, kMostDepth + 2> stack{};
  std::size_t count = 0;
  const Real first = max(span.from, range.from);
  if (!(first < span.to)) return;
  if (first < 0 && 0 < span.to) {
    stack[count++] = {0, span.to, 0};
    stack[count++] = {first, 0, 0};
  } else {
    stack[count++] = {first, span.to, 0};
  }
  SignWalk walk{first, at(first).value < 0};
  int steps = 0;
  while (count > 0) {
    checkBudget();
    const Stretch s = stack[--count];
    if (!(s.a < range.to)) return;
    const Real middle = s.a + 0.5 * (s.b - s.a);
    const auto over = bounds(Interval{s.a, s.b});
    const bool monotone = !over.slope.contains(0);
    Interval value = over.value;
    bool blurred = false;
    if (meanValue && value.contains(0) && !monotone) {  // sharper over short stretches
      const Interval here = bounds(Interval(middle)).value;
      value = here + over.slope * (Interval{s.a, s.b} - middle);
      blurred = value.high - value.low <= 2 * (here.high - here.low);  // halving tells no more
    }
    const bool none = !value.contains(0);
    const bool least =
        blurred || s.depth == kMostDepth || !(s.a < middle && middle < s.b) || ++steps > kMostSteps;
    if (none || monotone || least) {
      const bool after = none ? value.high < 0 : at(s.b).value < 0;
      const auto root = [&](Real a, Real b, bool before) { return none ? a : rootBetween(at, a, b, before); };
      walk.to(s.b, after, root, visit);
      continue;
    }
    stack[count++] = {middle, s.b, s.depth + 1};
    stack[count++] = {s.a, middle, s.depth + 1};
  }
}

}  // namespace trace
