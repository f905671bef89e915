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
  }
  return d;
}

Jet TracedJulia::value(const Vec3& p, const Vec3& direction) const {
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
  // Within a ball: what is farther out escapes.
  const Vec3& direction = ray.direction;
  const Real a = dot(direction, direction), b = dot(ray.origin, direction);
  const Vec3 nearest = ray.origin - direction * (b / a);
  const Roots2 ball = solveQuadratic(a, b, dot(ray.origin, ray.origin) - kReach * kReach,
                                     a * (kReach * kReach - dot(nearest, nearest)));
  if (!ball.count) return;
  const Real speed = std::sqrt(a);
  const auto bounds = [&](const Interval& t) {
    return over(ray.at(0.5 * (t.low + t.high)), 0.5 * (t.high - t.low) * speed * (1 + gammaError(8)),
                direction);
  };
  const auto at = [&](Real t) { return value(ray.at(t), direction); };
  intervalCrossings<28, false>({ball.t0, ball.t1}, range, bounds, at, [&](Real t, bool) {
    visit(Crossing{t, 0});
  });
}

SurfacePoint TracedJulia::surface(const Ray& ray, const Crossing& crossing) const {
  const Vec3 p = ray.at(crossing.t);
  const Number start = lift(p), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  Number q = shape_.mandelbrot ? Number{} : start;
  std::array<Number, 3> by = axes_;
  if (shape_.mandelbrot) by = {};
  Real off = gammaError(8) * (length(p) + size(shift_));  // how far rounding has moved q
  for (int i = 0; i < shape_.iterations; ++i) {
    const Real s = size(q);
    const Real stretch = shape_.iteration == Iteration::cube ? 3 * s * s : 2 * kStretch * s;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      by[axis] = stepSlope(q, by[axis]);
      if (shape_.mandelbrot) by[axis] = by[axis] + axes_[axis];
    }
    off = stretch * off + gammaError(32) * (s * s * max(s, 1) + size(c));
    q = step(q) + c;
    if (dot(q, q) > kEscaped * kEscaped) break;
  }
  const Vec3 gradient{dot(q, by[0]), dot(q, by[1]), dot(q, by[2])};
  const Real l = length(gradient);
  const Vec3 n = l > 0 && std::isfinite(l) ? gradient / l : normalize(-ray.direction);
  constexpr Real kMost = 1e-9;  // where the set is too folded for rounding to tell
  const Real e = min(2 * off * size(q) / l, kMost) + maxComponent(abs(p)) * gammaError(8);
  const Vec3 d = normalize(p);
  return {p,
          {e, e, e},
          n,
          n,
          {0.5 + std::atan2(d.y, d.x) / (2 * kPi), 0.5 + std::asin(std::clamp(d.z, -1.0, 1.0)) / kPi}};
}

}  // namespace trace
