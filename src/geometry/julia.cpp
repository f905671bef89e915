#include "geometry/julia.h"

#include <algorithm>

#include "geometry/interval_search.h"

namespace trace {
namespace {

using Number = std::array<Real, 4>;

Number operator+(const Number& a, const Number& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
Number operator*(const Number& a, Real s) { return {a[0] * s, a[1] * s, a[2] * s, a[3] * s}; }
Real dot(const Number& a, const Number& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }
Real size(const Number& a) { return std::sqrt(dot(a, a)); }

Number quaternionProduct(const Number& a, const Number& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}
Number hypercomplexProduct(const Number& a, const Number& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] + a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] - a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] + a[2] * b[0] - a[1] * b[3] - a[3] * b[1],
          a[0] * b[3] + a[3] * b[0] + a[1] * b[2] + a[2] * b[1]};
}
/// |a b| <= kStretch |a| |b| for hypercomplex numbers, which have divisors of zero.
constexpr Real kStretch = 1.4142135623730951;

/// A quaternion as a + b n, with b >= 0 and n an imaginary unit: functions of it are those of a + b i.
struct Polar {
  Real a, b;
  Vec3 n;
};
Polar polar(const Number& q) {
  const Vec3 v{q[1], q[2], q[3]};
  const Real b = length(v);
  return {q[0], b, b > 0 ? v / b : Vec3{1, 0, 0}};
}
Number composed(Real a, const Vec3& v) { return {a, v.x, v.y, v.z}; }

/// The change of a function of quaternions with real coefficients: f = (fa, fb) at q, g its complex
/// derivative.
Number functionSlope(const Polar& q, Real fb, Real ga, Real gb, const Number& change) {
  const Vec3 v{change[1], change[2], change[3]};
  const Real da = change[0], db = dot(v, q.n);
  const Vec3 across = (v - q.n * db) * (q.b > 0 ? fb / q.b : ga);
  return composed(ga * da - gb * db, q.n * (ga * db + gb * da) + across);
}

}  // namespace

std::shared_ptr<const TracedJulia> Julia::prepared() const {
  return std::make_shared<const TracedJulia>(*this);
}

TracedJulia::TracedJulia(const Julia& shape) : shape_(shape) {
  shape_.iterations = std::clamp(shape.iterations, 1, 50);
  Number n = shape.normal;
  const Real l = size(n);
  n = l > 0 && std::isfinite(1 / l) ? n * (1 / l) : Number{0, 0, 0, 1};
  shift_ = n * shape.offset;
  // x, y, z made perpendicular to the normal and each other; the axis nearest the normal stands for the last.
  std::size_t dropped = 3;
  for (std::size_t i = 0; i < 4; ++i)
    if (std::abs(n[i]) > std::abs(n[dropped])) dropped = i;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == dropped) continue;
    Number a{};
    a[i] = 1;
    a = a + n * -dot(a, n);
    for (std::size_t k = 0; k < count; ++k) a = a + axes_[k] * -dot(a, axes_[k]);
    axes_[count++] = a * (1 / size(a));
  }
}

TracedJulia::Number TracedJulia::lift(const Vec3& p) const {
  return axes_[0] * p.x + axes_[1] * p.y + axes_[2] * p.z + shift_;
}

TracedJulia::Number TracedJulia::step(const Number& q) const {
  switch (shape_.iteration) {
    case Iteration::square: return quaternionProduct(q, q);
    case Iteration::cube: return quaternionProduct(quaternionProduct(q, q), q);
    case Iteration::hypercomplex: return hypercomplexProduct(q, q);
    case Iteration::sine: {
      const Polar p = polar(q);
      return composed(std::sin(p.a) * std::cosh(p.b), p.n * (std::cos(p.a) * std::sinh(p.b)));
    }
    case Iteration::exponential: {
      const Polar p = polar(q);
      return composed(std::exp(p.a) * std::cos(p.b), p.n * (std::exp(p.a) * std::sin(p.b)));
    }
  }
  return q;
}

TracedJulia::Number TracedJulia::stepSlope(const Number& q, const Number& d) const {
  switch (shape_.iteration) {
    case Iteration::square: return quaternionProduct(q, d) + quaternionProduct(d, q);
    case Iteration::cube: {
      const Number square = quaternionProduct(q, q);
      return quaternionProduct(quaternionProduct(q, d) + quaternionProduct(d, q), q) +
             quaternionProduct(square, d);
    }
    case Iteration::hypercomplex: return hypercomplexProduct(q, d) * 2;
    case Iteration::sine: {
      const Polar p = polar(q);
      const Real c = std::cos(p.a), s = std::sin(p.a), ch = std::cosh(p.b), sh = std::sinh(p.b);
      return functionSlope(p, c * sh, c * ch, -s * sh, d);
    }
    case Iteration::exponential: {
      const Polar p = polar(q);
      const Real a = std::exp(p.a) * std::cos(p.b), b = std::exp(p.a) * std::sin(p.b);
      return functionSlope(p, b, a, b, d);
    }
  }
  return d;
}

Real TracedJulia::escape(const Number& q) const {
  switch (shape_.iteration) {
    case Iteration::sine: return polar(q).b;
    case Iteration::exponential: return q[0];
    default: return size(q);
  }
}

Real TracedJulia::escapeSlope(const Number& q, const Number& change) const {
  const Polar p = polar(q);
  switch (shape_.iteration) {
    case Iteration::sine: return dot(p.n, {change[1], change[2], change[3]});
    case Iteration::exponential: return change[0];
    default: return dot(q, change) / size(q);
  }
}

Real TracedJulia::stretch(const Number& q, Real r) const {
  const Real s = size(q) + r;
  switch (shape_.iteration) {
    case Iteration::square: return 2 * s;
    case Iteration::cube: return 3 * s * s;
    case Iteration::hypercomplex: return 2 * kStretch * s;
    case Iteration::sine: return std::cosh(polar(q).b + r);
    case Iteration::exponential: return std::exp(q[0] + r);
  }
  return kInfinity;
}

Jet TracedJulia::functionValue(const Vec3& p, const Vec3& direction) const {
  const Number start = lift(p), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  const Number along = axes_[0] * direction.x + axes_[1] * direction.y + axes_[2] * direction.z;
  Number q = shape_.mandelbrot ? Number{} : start, d = shape_.mandelbrot ? Number{} : along;
  const Real l = length(p);
  Jet most{l - kReach, l > 0 ? dot(p, direction) / l : 0};
  for (int i = 0; i < shape_.iterations; ++i) {  // to the last: only so it is continuous
    d = stepSlope(q, d);
    if (shape_.mandelbrot) d = d + along;
    q = step(q) + c;
    const Real excess = escape(q) - kEscaped;
    constexpr Real kHuge = 100;
    if (!(excess < kHuge)) return {kHuge, 0};
    if (excess > most.value) most = {excess, escapeSlope(q, d)};
  }
  return most;
}

Interval TracedJulia::functionSigns(const Vec3& center, Real radius) const {
  constexpr Real kRounding = 1 + gammaError(64), kHuge = 100;
  const Number start = lift(center), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  Number q = shape_.mandelbrot ? Number{} : start;
  Real r = shape_.mandelbrot ? 0 : radius;
  bool inside = (length(center) + radius) * kRounding < kReach;
  if (length(center) - radius > kReach * kRounding) return {1, 1};
  for (int i = 0; i < shape_.iterations; ++i) {
    r = (r * stretch(q, r) + (shape_.mandelbrot ? radius : 0)) * kRounding;
    q = step(q);
    r += size(q) * gammaError(64);
    q = q + c;
    const Real escaped = escape(q), rounding = size(q) * gammaError(64);
    if (escaped - r > kEscaped + rounding) return {1, 1};
    if (!(r < kHuge)) return {-1, 1};
    inside = inside && escaped + r < kEscaped - rounding;
  }
  return inside ? Interval{-1, -1} : Interval{-1, 1};
}

Jet TracedJulia::value(const Vec3& p, const Vec3& direction) const {
  if (!power()) return functionValue(p, direction);
  const Number start = lift(p), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  const Number along = axes_[0] * direction.x + axes_[1] * direction.y + axes_[2] * direction.z;
  Number q = shape_.mandelbrot ? Number{} : start, d = shape_.mandelbrot ? Number{} : along;
  for (int i = 0; i < shape_.iterations; ++i) {
    d = stepSlope(q, d);
    if (shape_.mandelbrot) d = d + along;
    q = step(q) + c;
    if (dot(q, q) > kEscaped * kEscaped && i + 1 < shape_.iterations) return {1, 0};
  }
  return {dot(q, q) - kEscaped * kEscaped, 2 * dot(q, d)};
}

Along<Interval> TracedJulia::over(const Vec3& center, Real radius, const Vec3& direction) const {
  constexpr Real kRounding = 1 + gammaError(64), kHuge = 1e60;
  const Interval outside{1, 1}, inside{-1, -1}, either{-1, 1};
  if (!power()) return {functionSigns(center, radius), Interval::everything()};
  const Number start = lift(center), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  const Number along = axes_[0] * direction.x + axes_[1] * direction.y + axes_[2] * direction.z;
  const Real more = shape_.mandelbrot ? radius : 0;
  Number q = shape_.mandelbrot ? Number{} : start, d = shape_.mandelbrot ? Number{} : along;
  Real r = shape_.mandelbrot ? 0 : radius, e = 0;  // q and d are within r and e of where they would be
  for (int i = 0; i < shape_.iterations; ++i) {
    const Real s = size(q), l = size(d);
    switch (shape_.iteration) {
      case Iteration::square:
        e = 2 * (s * e + r * (l + e));
        r = (2 * s + r) * r;
        break;
      case Iteration::cube:
        e = 3 * (s * s * e + (2 * s + r) * r * (l + e));
        r = (3 * s * s + (3 * s + r) * r) * r;
        break;
      case Iteration::hypercomplex:
        e = 2 * kStretch * (s * e + r * (l + e));
        r = kStretch * (2 * s + r) * r;
        break;
      default: return {either, Interval::everything()};
    }
    d = stepSlope(q, d);
    if (shape_.mandelbrot) d = d + along;
    q = step(q) + c;
    r = (r + more) * kRounding, e = e * kRounding + l * gammaError(64);
    const Real now = size(q);
    if (now - r > kEscaped * kRounding) return {outside, Interval::everything()};
    if (!(now + r < kHuge && e < kHuge)) return {either, Interval::everything()};
  }
  if ((size(q) + r) * kRounding < kEscaped) return {inside, Interval::everything()};
  const Real slope = dot(q, d), unsure = (size(q) * e + (size(d) + e) * r) * kRounding;
  return {either, {slope - unsure, slope + unsure}};
}

void TracedJulia::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  // Within a ball: what is farther out escapes, or is cut off; which the value tells just inside of its ends.
  const Real reach = power() ? kReach : kReach * (1 + std::ldexp(1.0, -40));
  const Vec3& direction = ray.direction;
  const Real a = dot(direction, direction), b = dot(ray.origin, direction);
  const Vec3 nearest = ray.origin - direction * (b / a);
  const Roots2 ball = solveQuadratic(a, b, dot(ray.origin, ray.origin) - reach * reach,
                                     a * (reach * reach - dot(nearest, nearest)));
  if (!ball.count) return;
  const Real speed = std::sqrt(a);
  const auto bounds = [&](const Interval& t) {
    return over(ray.at(0.5 * (t.low + t.high)), 0.5 * (t.high - t.low) * speed * (1 + gammaError(8)),
                direction);
  };
  const auto at = [&](Real t) { return value(ray.at(t), direction); };
  const auto found = [&](Real t, bool) { visit(Crossing{t, 0}); };
  // Functions fold space everywhere: looking as closely as at powers would take seconds.
  if (power())
    intervalCrossings<28, false>({ball.t0, ball.t1}, range, bounds, at, found);
  else
    intervalCrossings<14, false>({ball.t0, ball.t1}, range, bounds, at, found);
}

SurfacePoint TracedJulia::surface(const Ray& ray, const Crossing& crossing) const {
  const Vec3 p = ray.at(crossing.t);
  const Number start = lift(p), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  Number q = shape_.mandelbrot ? Number{} : start;
  std::array<Number, 3> by = axes_;
  if (shape_.mandelbrot) by = {};
  Real off = gammaError(8) * (length(p) + size(shift_));  // how far rounding has moved q
  // Of the powers the last number tells how the surface lies; else that which passes the limit most.
  Real most = length(p) - kReach, error = off;
  Vec3 gradient = p;
  for (int i = 0; i < shape_.iterations; ++i) {
    const Real s = size(q);
    const Real longer = stretch(q, 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      by[axis] = stepSlope(q, by[axis]);
      if (shape_.mandelbrot) by[axis] = by[axis] + axes_[axis];
    }
    q = step(q);
    off = longer * off + gammaError(32) * (s * s * max(s, 1) + size(q) + size(c));
    q = q + c;
    const Real excess = escape(q) - kEscaped;
    if (power() || excess > most) {
      most = excess, error = off;
      gradient = {escapeSlope(q, by[0]), escapeSlope(q, by[1]), escapeSlope(q, by[2])};
    }
    if (!(excess <= 0)) break;
  }
  const Real l = length(gradient);
  const Vec3 n = l > 0 && std::isfinite(l) ? gradient / l : normalize(-ray.direction);
  constexpr Real kMost = 1e-9;  // where the set is too folded for rounding to tell
  // This crossing and that of a ray that starts here are each found by a value that is off by so much.
  const Real e = min(4 * error / l, kMost) + maxComponent(abs(p)) * gammaError(8);
  return {p, {e, e, e}, n, n, shape_.trap == Trap::none ? sphereUv(p) : trapUv(p)};
}

Vec2 TracedJulia::trapUv(const Vec3& p) const {
  OrbitTrap trap(shape_.trap, kEscaped);
  const Number start = lift(p), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  Number q = shape_.mandelbrot ? Number{} : start;
  for (int i = 0; i < shape_.iterations && escape(q) <= kEscaped; ++i) {
    q = step(q) + c;
    const Vec3 across{q[1], q[2], q[3]};
    trap.visit(q[0], length(across));
  }
  return trap.uv();
}

}  // namespace trace
