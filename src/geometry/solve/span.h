// Stretches of a ray's line, and where it runs through a convex body.
#pragma once

#include <cstdint>
#include <utility>

#include "geometry/ray.h"
#include "math/box.h"
#include "math/roots.h"

namespace trace {

/// from <= t <= to; empty if not from < to.
struct Span {
  Real from = -kInfinity, to = kInfinity;
  bool empty() const { return !(from < to); }
};

/// Enlarged by far more than rounding: a surface that touches the box stays clear of its faces.
inline Box3 roomy(const Box3& box) {
  const Real size = maxComponent(max(abs(box.low), abs(box.high)));
  const Vec3 room = Vec3{1, 1, 1} * (std::ldexp(1.0, -40) * size);
  return {box.low - room, box.high + room};
}

/// Where the line of a ray enters a box and leaves it. A part is 2 axis + (0 for the low face, 1 for the
/// high).
struct BoxCrossings {
  Crossing in{-kInfinity, 0}, out{kInfinity, 0};  ///< a miss has in.t > out.t
};

/// By slabs, axis by axis (Kay and Kajiya, SIGGRAPH 1986, section 2).
inline BoxCrossings crossingsOf(const Box3& box, const Ray& ray) {
  BoxCrossings found;
  for (int axis = 0; axis < 3; ++axis) {
    const Real o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < box.low[axis] || o > box.high[axis]) return {{kInfinity, 0}, {-kInfinity, 0}};
      continue;
    }
    const std::int64_t face = std::int64_t{2} * axis;
    Crossing low{(box.low[axis] - o) / d, face}, high{(box.high[axis] - o) / d, face + 1};
    if (d < 0) std::swap(low, high);
    if (low.t > found.in.t) found.in = low;
    if (high.t < found.out.t) found.out = high;
  }
  return found;
}

/// Where the line of the ray is in the box, up to rounding.
inline Span spanIn(const Box3& box, const Ray& ray) {
  const auto [in, out] = crossingsOf(box, ray);
  return {in.t, out.t};
}

/// The line of a ray, to be held against many boxes: it is divided by the direction once.
class LineProbe {
 public:
  explicit LineProbe(const Ray& ray)
      : origin_(ray.origin),
        direction_(ray.direction),
        inverse_{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z} {}

  /// Whether the line runs through the box, up to rounding.
  bool meets(const Box3& box) const {
    Span span;
    for (int axis = 0; axis < 3; ++axis) {
      const Real o = origin_[axis];
      if (direction_[axis] == 0) {
        if (o < box.low[axis] || o > box.high[axis]) return false;
        continue;
      }
      const Real low = (box.low[axis] - o) * inverse_[axis], high = (box.high[axis] - o) * inverse_[axis];
      span.from = max(span.from, min(low, high));
      span.to = min(span.to, max(low, high));
    }
    return !span.empty();
  }

 private:
  Vec3 origin_, direction_, inverse_;
};

/// Where f, convex along the line, is negative: visits entry and exit with numbers 0 and 1, as far as they
/// are in the range. f is not negative at the ends of the span. Newton's steps from outside never pass a root
/// of a convex function.
template <class F, class Visit>
void convexCrossings(Span span, const Range& range, F&& f, Visit&& visit) {
  bool inside = false;
  if (span.from < 0 && span.to > 0) {  // the side of the origin is decided at the origin
    const Jet at = f(0.0);
    inside = at.value < 0;
    if (!inside) (at.slope < 0 ? span.from : span.to) = 0;
  }
  const auto approach = [&](Real t, Real end) {
    constexpr int kMost = 200;
    const Real forward = end > t ? 1 : -1;
    for (int i = 0; i < kMost; ++i) {
      const Jet at = f(t);
      if (at.value <= 0) break;
      if (!(at.slope * forward < 0)) return kInfinity;  // past the lowest place: a miss
      const Real next = t - at.value / at.slope;
      if ((next - t) * forward <= 0) break;
      if ((end - next) * forward < 0) return kInfinity;
      t = next;
    }
    return t;
  };
  Real in = 0;
  if (!inside || range.from < 0) {
    in = approach(span.from, span.to);
    if (inside) in = min(in, 0);
    if (in == kInfinity) return;
    if (range.from >= 0 && in > range.from) {  // the exit is found only if it is wanted
      visit(in, 0);
      if (range.to <= in) return;
    }
  }
  Real out = approach(span.to, in);
  if (inside) out = out == kInfinity ? 0 : max(out, 0);
  if (out == kInfinity || out < in) return;
  if (range.from < 0) visit(in, 0);
  visit(out, 1);
}

}  // namespace trace
