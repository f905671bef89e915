// Every place along a line where a function changes sign, found by looking at four stretches at once: one
// over which the function surely keeps its sign is passed, one over which it only rises or only falls is
// decided by the signs at its ends. The first of which neither is known is quartered; where all four are
// passed the next are twice as long. What tells so much of a whole stretch is the function in its middle,
// with bounds of its derivatives (the mean value forms of Moore, Interval Analysis, 1966).
#pragma once

#include "base/budget.h"
#include "geometry/solve/span.h"

namespace trace {

/// Facts about four stretches of a line of equal length, one after another; bit i for number i.
struct FourStretches {
  unsigned inside = 0;    ///< the function is negative in the middle
  unsigned keeps = 0;     ///< it keeps that sign all along
  unsigned monotone = 0;  ///< it only rises or only falls
};

/// Calls visit(t, insideBefore) in order along the span for the changes of sign of a function, negative
/// inside, in the range. `look`(t, half) gives the FourStretches from t on, each twice `half` long; `at`(t)
/// the Jet. The function is not negative at the ends of the span. Stretches are not halved below `least`:
/// then the signs at their ends decide.
///
/// Nothing hangs: after very many looks the rest is decided by the sign at its end.
template <class Look, class At, class Visit>
void stretchCrossings(const Span& span, const Range& range, Real least, Look&& look, At&& at, Visit&& visit) {
  constexpr int kMostLooks = 20000;
  constexpr Real kFromOutside = 1.0 / 32, kFromWithin = 1.0 / 2048;  // the first half, of the whole
  const Real first = max(span.from, range.from);
  if (!(first < span.to)) return;
  SignWalk walk{first, first > span.from && at(first).value < 0};
  // Within the span a ray mostly starts on the surface, near which only short stretches are known.
  Real half = (span.to - first) * (first > span.from ? kFromWithin : kFromOutside);
  for (int looks = 0; walk.at < span.to && walk.at < range.to; ++looks) {
    checkBudget();
    // On which side a ray starts is decided at its origin.
    const Real begin = walk.at;
    const Real end = begin < 0 && span.to > 0 ? 0 : span.to;
    const bool last = looks >= kMostLooks;
    const Real most = last ? (end - begin) / 2 : (end - begin) / 8;
    const bool whole = !(half < most);
    half = max(min(half, most), least);
    const FourStretches known = last ? FourStretches{} : look(begin, half);
    const bool shortest = last || half == least;
    int passed = 0;
    for (; passed < 4 && walk.at < end && walk.at < range.to; ++passed) {
      const unsigned bit = 1u << passed;
      const bool keeps = known.keeps & bit;
      if (!keeps && !(known.monotone & bit) && !shortest) break;
      const Real to = last || (whole && passed == 3) ? end : min(begin + 2 * half * (passed + 1), end);
      const Real next = max(to, onward(walk.at, 1));
      const bool after = next < span.to && (keeps ? (known.inside & bit) != 0 : at(next).value < 0);
      const auto root = [&](Real a, Real b, bool before) {
        return keeps ? a : rootBetween(at, a, b, before);
      };
      walk.to(next, after, root, visit);
    }
    half *= passed == 4 ? 2 : 0.25;
  }
}

}  // namespace trace
