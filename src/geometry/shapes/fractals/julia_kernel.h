// Proven facts about four stretches of a ray through a Julia set of powers, at once. Compiled once for
// each instruction set (julia_kernel_*.cpp), all with the same arithmetic.
//
// The orbit of the middle of a stretch, its change along the ray and a bound of its second derivative over
// the stretch bound |q|^2 all along it, at every repetition. Where that surely passes the size from which a
// number escapes, the whole stretch is outside; where it surely stays below the size from which it stays,
// inside.
#pragma once

#include "accel/simd.h"
#include "geometry/shapes/fractals/julia_set.h"

namespace trace::simd {
namespace {  // each including file has its own, compiled with its own flags

template <Iteration kIteration>
FourStretches lookAt(const JuliaSet& set, const julia::Number<Real>& place, const julia::Number<Real>& unit,
                     Real half) {
  using Numbers = julia::Number<Double4>;
  alignas(16) static constexpr float kMiddles[] = {1, 3, 5, 7};
  constexpr Real kRounding = 1 + 0x1p-46;  // far above that of a few steps
  const auto all = [](Real x) { return Double4::all(x); };
  const auto allOf = [&](const julia::Number<Real>& q) {
    return Numbers{all(q.a), all(q.i), all(q.j), all(q.k)};
  };
  const Double4 zero = all(0), w = all(half * kRounding), share = all(set.share), own = all(1 - set.share);
  const Double4 most = all(set.mostConstant), rounding = all(0x1p-47), up = all(kRounding);
  const Numbers along = allOf(unit), start = allOf(place) + along * (Double4::widen(kMiddles) * all(half));
  const Numbers c = allOf(set.constant) + start * share, more = along * share;
  Numbers q = start * own, d = along * own;  // d: the change of q along the ray
  Double4 m = zero;                          // a bound of the second derivative of q
  Double4 error = all(0x1p-49 * (set.reach + set.mostConstant)), bent = zero;  // rounding of q, of d, at most
  const Double4 mostGrowth = all(set.mostGrowth);
  Double4 growth = own;  // largest growth of distances between numbers of the stretch
  FourStretches known;
  unsigned open = 15;  // those still followed
  for (int i = 0;; ++i) {
    const Double4 square = dot(q, q), product = dot(q, d);
    const Double4 s = sqrt(square) * up + error, l = sqrt(dot(d, d)) * up + bent;  // sizes, at most
    const Double4 escapes = all(set.escapes[i]), stays = all(set.stays[i]);
    const Double4 out = square - escapes * escapes, in = stays * stays - square;
    const unsigned beyond = less(zero, out), below = less(zero, in);
    if (((beyond | below) & open) != 0 || i == set.iterations) {
      const Double4 slope = max(product, zero - product) * all(2), speed = l + w * m;
      const Double4 pull = (s + w * (l + all(0.5) * (w * m))) * m;
      const Double4 push = (speed * speed + pull) * all(2) * up;  // largest push of the slope
      const Double4 change = w * (slope + all(0.5) * (w * push)) + all(2) * (s * error);
      const unsigned sure = less(change * up, max(out, in)) & open;
      known.keeps |= sure;
      if (i == set.iterations) {
        known.inside |= below & open;
        known.monotone = less((push * w + all(2) * (s * bent + l * error)) * up, slope) & open;
        return known;
      }
      known.inside |= sure & below;
      open &= ~sure & ~less(all(4) * (escapes * escapes), square);  // there following it tells less
      if (open == 0) return known;
    }
    // Where an orbit may end here, what follows tells nothing of it.
    const Double4 farthest = (s + w * (l + all(0.5) * (w * m))) * up;
    growth = (julia::stretch<kIteration>(farthest) * growth + share) * up;
    if (i >= JuliaSet::kSurely) open &= ~less(mostGrowth, growth);
    if (open == 0) return known;
    const Double4 longer = julia::stretch<kIteration>(s);
    const Double4 turn = kIteration == Iteration::cube ? all(6) * s : all(3);  // turn of the step's slope
    bent = longer * bent + turn * (l * error) + rounding * (longer * l);
    error = longer * error + rounding * (longer * s + most);
    m = julia::bend<kIteration>(s, l, m, w) * up;
    d = julia::slope<kIteration>(q, d, square, product) + more;
    q = julia::step<kIteration>(q, square) + c;
  }
}

}  // namespace
}  // namespace trace::simd
