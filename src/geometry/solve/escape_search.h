// Solids of points of space whose orbit w -> f(w) + c stays within a radius for a number of steps, cut by a
// box.
//
// Not found by estimates of distance: whole stretches of the ray, as balls, are followed through the steps
// with a bound of how much f can stretch them. A ball that is all outside at some step, or all inside to the
// last, needs no more looking at; others are halved. What is left out is proven empty; at the least length,
// some 1e-5 of the solid, the signs at the ends decide.
#pragma once

#include "geometry/shapes/fractals/orbit_trap.h"
#include "geometry/solve/interval_search.h"
#include "math/expression.h"
#include "math/transform.h"

namespace trace {

/// Step gives
///   radius()                what is farther out has escaped
///   half()                  half the width of the box
///   surely()                so many numbers of an orbit always count
///   iterations(), trap(), colored(): does a crossing tell how near its orbit came, as a TrapPart?
///   start(p), constant(p)   w and c of a place p; of which shareOfPlace(), 0 or 1, is how c follows p
///   unit()                  the length in the orbit's space of one in that of the ray
///   step(w)                 an Affine: its offset is f(w), its linear part the derivative
///   value(w)                f(w)
///   stretch(w, r)           how many times farther apart f takes points within r of w, at most
template <class Step>
class EscapeSearch {
 public:
  explicit EscapeSearch(const Step& step) : step_(step) {}

  Box3 bounds() const { return {Vec3{-1, -1, -1} * step_.half(), Vec3{1, 1, 1} * step_.half()}; }

  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
    const auto [in, out] = crossingsOf(bounds(), ray);
    if (!(in.t < out.t)) return;
    const Real speed = length(ray.direction);
    const auto over = [&](const Interval& t) {
      const Real radius = 0.5 * (t.high - t.low) * speed * (1 + gammaError(8));
      return Along<Interval>{signs(ray.at(0.5 * (t.low + t.high)), radius), Interval::everything()};
    };
    const auto at = [&](Real t) { return excess(ray.at(t), ray.direction); };
    const auto visitAt = [&](const Crossing& c) {
      visit({c.t, step_.colored() ? TrapPart::part(c.part, trapAt(ray.at(c.t)).x) : c.part});
    };
    if (in.t > range.from && at(in.t).value < 0) visitAt(in);
    constexpr int kMostDepth = 17;
    intervalCrossings<kMostDepth, false>({in.t, out.t}, range, over, at, [&](Real t, bool) {
      visitAt(Crossing{t, kSurface});
    });
    if (out.t > range.from && out.t <= range.to && at(out.t).value < 0) visitAt(out);
  }

  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    Vec3 p = ray.at(crossing.t), n;
    const Real half = step_.half();
    // The place on the ray is rounded as its origin and the way to it are.
    Real error = half * gammaError(8) +
                 (maxComponent(abs(ray.origin)) + std::abs(crossing.t) * maxComponent(abs(ray.direction))) *
                     gammaError(4);
    if (const std::int64_t face = TrapPart::face(crossing.part); face != kSurface) {
      const int axis = static_cast<int>(face / 2);
      n[axis] = face % 2 != 0 ? 1 : -1;
      p[axis] = n[axis] * half;
    } else {
      Real off = 0;
      bool blurred = false;
      const Vec3 gradient = gradientAt(p, off, blurred);
      const Real l = length(gradient);
      n = l > 0 && std::isfinite(l) ? gradient / l : normalize(-ray.direction);
      constexpr Real kMost = 1e-12;  // fraction of the size at which rounding cannot tell
      error += min(off / l, kMost * half);
      if (blurred) error += half * kDetail / 16;
    }
    return {p, {error, error, error}, n, n, uvAt(p)};
  }

 private:
  static constexpr std::int64_t kSurface = 6;  ///< part; below: the faces of the box
  static constexpr Real kHuge = 1e60;
  /// In sizes of half the box, some steps of the search: what is finer is not told apart.
  static constexpr Real kDetail = 0x1p-14;

  /// How far apart the orbits of places are, for one unit between the places: at most, within r of w.
  Real grown(Real growth, const Vec3& w, Real r) const {
    return growth * step_.stretch(w, r) + step_.unit() * step_.shareOfPlace();
  }
  /// The orbits of neighbours in the search have nothing in common any more. What follows is dust: each ray
  /// would hit other grains of it, and the place that one finds would lie in the shadow of others.
  /// The first numbers always count: their turns are few, and hold no dust.
  bool isBlurred(Real growth, int i) const {
    return i >= step_.surely() && growth * step_.half() * kDetail > step_.radius();
  }

  /// By how much the square of the orbit's greatest distance passes that of the radius; the slope is along
  /// the direction.
  Jet excess(const Vec3& p, const Vec3& direction) const {
    const Vec3 c = step_.constant(p), along = direction * step_.unit();
    const Real limit = step_.radius() * step_.radius();
    Vec3 w = step_.start(p), d = along;
    Jet most{dot(w, w) - limit, 2 * dot(w, d)};
    Real growth = step_.unit();
    for (int i = 0; i < step_.iterations(); ++i) {  // to the last: only so it is continuous
      growth = grown(growth, w, 0);
      if (isBlurred(growth, i)) break;
      const Affine f = step_.step(w);
      w = f.offset + c;
      d = linear(f, d) + along * step_.shareOfPlace();
      const Real value = dot(w, w) - limit;
      if (!(value < kHuge)) return {kHuge, 0};
      if (value > most.value) most = {value, 2 * dot(w, d)};
    }
    return most;
  }

  /// The sign of the excess over a ball.
  Interval signs(const Vec3& center, Real radius) const {
    constexpr Real kRounding = 1 + gammaError(64);
    const Vec3 c = step_.constant(center);
    const Real share = radius * step_.unit() * step_.shareOfPlace();
    Vec3 w = step_.start(center);
    Real r = radius * step_.unit();  // the orbits are within r of this one
    Real growth = step_.unit();
    bool inside = true;
    for (int i = 0;; ++i) {
      const Real l = length(w);
      if (l - r > step_.radius() * kRounding) return {1, 1};
      if (!(r < kHuge)) return {-1, 1};
      inside = inside && (l + r) * kRounding < step_.radius();
      if (i == step_.iterations()) return inside ? Interval{-1, -1} : Interval{-1, 1};
      growth = grown(growth, w, r);
      if (isBlurred(growth, i)) return {-1, 1};  // for some places of the ball this may be the last number
      r = (r * step_.stretch(w, r) + share) * kRounding;
      w = step_.value(w);
      r += length(w) * gammaError(64);
      w = w + c;
    }
  }

  /// The gradient of the excess; `off` is how far rounding has moved it.
  Vec3 gradientAt(const Vec3& p, Real& off, bool& blurred) const {
    const Vec3 c = step_.constant(p);
    const Real unit = step_.unit(), share = unit * step_.shareOfPlace();
    Vec3 w = step_.start(p);
    Affine by = Affine::scaling({unit, unit, unit});
    Real moved = length(w) * gammaError(8), most = -kInfinity, growth = unit;
    Vec3 gradient;
    for (int i = 0;; ++i) {
      const Real square = dot(w, w);
      if (square >= most) {
        most = square;
        off = 4 * (length(w) * moved + square * gammaError(8));
        gradient = transposed(by, w) * 2;
      }
      if (i == step_.iterations() || !(square < kHuge) ||
          square > step_.radius() * step_.radius() * (1 + 1e-6))
        return gradient;
      growth = grown(growth, w, 0);
      if ((blurred = isBlurred(growth, i))) return gradient;
      const Affine f = step_.step(w);
      moved = moved * step_.stretch(w, 0) + (length(f.offset) + length(c)) * gammaError(32);
      Affine linearPart = f;
      linearPart.offset = {};
      by = linearPart * by;
      for (int axis = 0; axis < 3; ++axis) by.row[axis][axis] += share;
      w = f.offset + c;
    }
  }

  SurfaceUv uvAt(const Vec3& p) const {
    return step_.trap() == Trap::none ? SurfaceUv::toward(normalize(p)) : SurfaceUv(trapAt(p));
  }

  Vec2 trapAt(const Vec3& p) const {
    OrbitTrap trap(step_.trap(), step_.radius());
    const Vec3 c = step_.constant(p);
    Vec3 w = step_.start(p);
    for (int i = 0; i < step_.iterations() && dot(w, w) < kHuge; ++i) {
      w = step_.value(w) + c;
      trap.visit(w.x, std::sqrt(w.y * w.y + w.z * w.z));
    }
    return trap.uv();
  }

  Step step_;
};

}  // namespace trace
