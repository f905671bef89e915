// Every place along a line where a function changes sign, found by interval arithmetic (Mitchell, Robust Ray
// Intersection with Interval Arithmetic, 1990): a stretch over which the function cannot be zero is left out,
// one over which it is monotone is decided by the signs at its ends, any other is halved.
#pragma once

#include <array>

#include "geometry/span.h"
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
    bool negativeAtB;
    int depth;
  };
  std::array<Stretch, kMostDepth + 2> stack{};
  std::size_t count = 0;
  const Real first = max(span.from, range.from);
  if (!(first < span.to)) return;
  const auto negative = [&](Real t) { return at(t).value < 0; };
  stack[count++] = {first, span.to, negative(span.to), 0};
  bool before = negative(first);
  if (first < 0 && 0 < span.to) {
    stack[0].a = 0;
    stack[count++] = {first, 0, negative(0), 0};
  }
  int steps = 0;
  while (count > 0) {
    const Stretch s = stack[--count];
    if (!(s.a < range.to)) return;
    const Real middle = s.a + 0.5 * (s.b - s.a);
    const auto over = bounds(Interval{s.a, s.b});
    const bool monotone = !over.slope.contains(0);
    bool none = !over.value.contains(0), blurred = false;
    if (meanValue && !none && !monotone) {  // sharper over short stretches
      const Interval here = bounds(Interval(middle)).value;
      const Interval all = here + over.slope * (Interval{s.a, s.b} - middle);
      none = !all.contains(0);
      blurred = all.high - all.low <= 2 * (here.high - here.low);  // halving tells no more
    }
    const bool least =
        blurred || s.depth == kMostDepth || !(s.a < middle && middle < s.b) || ++steps > kMostSteps;
    if (none || monotone || least) {
      if (before != s.negativeAtB) visit(rootBetween(at, s.a, s.b, before), before);
      before = s.negativeAtB;
      continue;
    }
    stack[count++] = {middle, s.b, s.negativeAtB, s.depth + 1};
    stack[count++] = {s.a, middle, negative(middle), s.depth + 1};
  }
}

}  // namespace trace
