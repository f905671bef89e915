// The traced form of every quadric: the points of a box where f <= 0, with
//   f = A x^2 + B y^2 + C z^2 + 2 (D x y + E x z + F y z) + 2 (G x + H y + I z) + J,
// closed by faces where it reaches the box, or open there (Glassner, section 2.3; the quadratic is solved
// without cancellation). The named quadrics of quadric.h are made of it by prepared().
#pragma once

#include <algorithm>
#include <utility>

#include "geometry/solve/span.h"

namespace trace {

struct ClippedQuadric {
  static constexpr int kSide = 6;  ///< part; below: 2 axis + (0 low, 1 high) of the box
  static constexpr int kBottom = 4, kTop = 5;

  Vec3 squares;   ///< A, B, C
  Vec3 products;  ///< D, E, F: half the coefficients of x y, x z, y z
  Vec3 linear;    ///< G, H, I: half the coefficients of x, y, z
  Real constant = 0;
  Box3 clip;    ///< infinite where the quadric ends by itself
  Box3 extent;  ///< extent of what is left
  bool capped = true;

  bool solid() const { return capped; }
  Box3 bounds() const { return extent; }

  Vec3 halfGradient(const Vec3& p) const { return times(p) + linear; }
  Real value(const Vec3& p) const { return dot(p, times(p) + linear * 2) + constant; }
  /// Bounds the rounding error of value() at p.
  Real valueError(const Vec3& p) const {
    const Vec3 q = abs(p);
    const Vec3 &s = squares, &m = products;
    const Real terms =
        std::abs(s.x) * q.x * q.x + std::abs(s.y) * q.y * q.y + std::abs(s.z) * q.z * q.z +
        2 * (std::abs(m.x) * q.x * q.y + std::abs(m.y) * q.x * q.z + std::abs(m.z) * q.y * q.z) +
        2 * dot(abs(linear), q) + std::abs(constant);
    return terms * gammaError(16);
  }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    const auto [in, out] = crossingsOf(clip, ray);
    if (!(in.t <= out.t)) return;

    // A far ray first comes near, where its quadratic keeps its digits; a near one is decided at its origin.
    const Span near = spanIn(roomy(extent), ray);
    if (near.empty()) return;
    const Real start = near.from > 0 ? near.from : near.to < 0 ? near.to : 0;
    const Vec3 o = start == 0 ? ray.origin : ray.at(start);
    const Vec3& d = ray.direction;
    const Real a = dot(d, times(d)), b = dot(d, halfGradient(o)), c = value(o);
    if (!std::isfinite(a + b + c)) return;
    if (a == 0) {
      if (b == 0) {
        if (c < 0) within(in, out, visit);
        return;
      }
      const Crossing root{start - c / (2 * b), kSide};
      if (b > 0)
        within(in, std::min(root, out, byT), visit);
      else
        within(std::max(root, in, byT), out, visit);
      return;
    }
    // b^2 - a c is the same all along the ray; least in error from where the quadratic turns, if that is
    // near.
    const Real turn = std::clamp(-b / a, near.from - start, near.to - start);
    const Vec3 q = o + d * turn;
    const Real bTurn = dot(d, halfGradient(q));
    const Roots2 roots = solveQuadratic(a, b, c, bTurn * bTurn - a * value(q));
    const Crossing first{start + roots.t0, kSide}, last{start + roots.t1, kSide};
    if (a > 0) {
      if (roots.count) within(std::max(first, in, byT), std::min(last, out, byT), visit);
    } else if (roots.count) {
      within(in, std::min(first, out, byT), visit);
      within(std::max(last, in, byT), out, visit);
    } else {
      within(in, out, visit);
    }
  }

  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    Vec3 p = ray.at(crossing.t), n, error;
    if (crossing.part != kSide) {
      const int axis = static_cast<int>(crossing.part / 2);
      const bool high = crossing.part % 2 != 0;
      p[axis] = high ? clip.high[axis] : clip.low[axis];
      n[axis] = high ? 1 : -1;
      error = max(abs(extent.low), abs(extent.high)) * gammaError(6);
    } else {
      Vec3 g = halfGradient(p);
      for (int step = 0; step < 2; ++step) {  // back to the surface along the gradient
        const Real square = dot(g, g);
        if (!(square > 0)) break;
        const Vec3 next = p - g * (value(p) / (2 * square));
        if (!isFinite(next) || length(next - p) > length(extent.size()) * 1e-3) break;
        p = next;
        g = halfGradient(p);
      }
      for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], clip.low[i], clip.high[i]);
      const Real l = length(g), e = valueError(p);
      n = l > 0 ? g / l : Vec3{0, 0, 1};
      // Where the gradient vanishes, at the tip of a cone, the surface bends: its error is a square root.
      const Real curved = std::sqrt(e / maxComponent(abs(squares) + abs(products)));
      const Real off = min(l > 0 ? e / l : kInfinity, curved);
      const Real size = maxComponent(max(abs(extent.low), abs(extent.high))) * gammaError(6) + off;
      error = {size, size, size};
    }
    if (!capped && dot(n, ray.direction) > 0) n = -n;
    return {p, error, n, n, uv(p, crossing.part)};
  }

 private:
  static bool byT(const Crossing& a, const Crossing& b) { return a.t < b.t; }

  Vec3 times(const Vec3& p) const {
    return {squares.x * p.x + products.x * p.y + products.y * p.z,
            products.x * p.x + squares.y * p.y + products.z * p.z,
            products.y * p.x + products.z * p.y + squares.z * p.z};
  }

  /// u goes around z, v up; on the ends back from the rim to the middle.
  SurfaceUv uv(const Vec3& p, std::int64_t part) const {
    const Real height = extent.high.z - extent.low.z;
    if (part == kBottom || part == kTop) {
      const Real middle = value({0, 0, p.z});
      const Real outward = middle < 0 ? std::sqrt(std::clamp(1 - value(p) / middle, 0.0, 1.0)) : 0;
      return SurfaceUv::around(p, part == kBottom ? 1 - outward : outward);
    }
    return SurfaceUv::around(p, height > 0 ? std::clamp((p.z - extent.low.z) / height, 0.0, 1.0) : 0);
  }

  template <class Visit>
  void within(const Crossing& in, const Crossing& out, Visit& visit) const {
    if (!(in.t <= out.t)) return;
    if (capped || in.part == kSide) visit(in);
    if (capped || out.part == kSide) visit(out);
  }
};

}  // namespace trace
