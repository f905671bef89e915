// Every place along a line where a function changes sign, found by strides: as in sphere tracing (Hart 1996)
// the search goes from each place as far as something is known, but what is known is proven: that the sign
// stays, or that the function only nears zero and passes it, so that the signs at the ends tell of its one
// crossing.
#pragma once

#include "geometry/span.h"
#include "math/interval.h"

namespace trace {

/// What is known of a function at a place on a line.
struct Stride {
  Real value = 0;  ///< negative inside
  Real reach = 0;  ///< so far ahead it keeps its sign, or only nears zero and passes it
};

/// How far ahead a function surely keeps its sign, from its value, slope, bounds of its second derivative up
/// to `within` ahead, and a bound of the rounding of the value.
inline Real keepsSign(Real value, Real slope, const Interval& bend, Real within, Real error) {
  const Real sign = value < 0 ? -1 : 1, away = sign * slope, off = std::abs(value) - error;
  if (!(off > 0)) return 0;
  const Real pull = sign > 0 ? -bend.low : bend.high;  // off + away x - pull x^2 / 2 > 0
  constexpr Real kUseless = 1e100;                     // and near to where numbers end
  if (!(pull < kUseless)) return 0;
  if (!(pull > 0)) return away < 0 ? min(off / -away, within) : within;
  const Real root = std::sqrt(away * away + 2 * pull * off);
  return min(away < 0 ? 2 * off / (root - away) : (away + root) / pull, within) * (1 - gammaError(64));
}

/// How far ahead it surely only nears zero, and passes it.
inline Real nearsZero(Real value, Real slope, const Interval& bend, Real within) {
  const Real nearing = value < 0 ? slope : -slope, push = value < 0 ? -bend.low : bend.high;
  if (!(nearing > 0 && push < kInfinity)) return 0;
  return (push > 0 ? min(nearing / push, within) : within) * (1 - gammaError(64));
}

/// Calls visit(t, insideBefore) in order along the span for the changes of sign of a function, negative
/// inside, in the range. `look`(t, wanted) gives the Stride there, `wanted` telling how far it would like to
/// know; `at`(t) the Jet. The function is not negative at the ends of the span. Where less than `least` is
/// known a stride is that long, and the signs at its ends decide.
///
/// Nothing hangs: after very many strides the rest is decided by the sign at its end.
template <class Look, class At, class Visit>
void strideCrossings(const Span& span, const Range& range, Real least, Look&& look, At&& at, Visit&& visit) {
  constexpr int kMostStrides = 20000;
  constexpr Real kAtFirst = 0.25, kLonger = 1.4;  // wanted: of the whole, of the last stride
  Real t = max(span.from, range.from);
  if (!(t < span.to)) return;
  Stride here = look(t, kAtFirst * (span.to - t));
  if (t == span.from) here.value = max(here.value, 0);
  for (int strides = 0; t < span.to && t < range.to; ++strides) {
    // On which side a ray starts is decided at its origin.
    const Real end = strides < kMostStrides && t < 0 && span.to > 0 ? 0 : span.to;
    const Real surely = max(t + max(here.reach, least), std::nextafter(t, kInfinity));
    const Real next = strides < kMostStrides ? min(surely, end) : end;
    Stride there = look(next, kLonger * (next - t));
    if (next >= span.to) there.value = max(there.value, 0);
    const bool inside = here.value < 0;
    if (inside != (there.value < 0)) visit(rootBetween(at, t, next, inside), inside);
    t = next, here = there;
  }
}

}  // namespace trace
