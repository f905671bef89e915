#include "geometry/shapes/solids/supertoroid.h"

#include <algorithm>

#include "geometry/solve/interval_search.h"
#include "math/elementary.h"
#include "math/expression.h"

namespace trace {
namespace {

Real torusExponent(Real squareness) { return 2 / std::clamp(squareness, 0.05, 2.0); }

/// (a^p + b^p)^(1/p) for a, b >= 0, without overflow.
Real norm(Real a, Real b, Real p) {
  const Real most = max(a, b), least = min(a, b);
  if (most == 0) return 0;
  if (p == 1) return a + b;
  if (p == 2) return std::sqrt(a * a + b * b);
  return most * math::pow(1 + math::pow(least / most, p), 1 / p);
}
/// How the norm changes with a: (a / norm)^(p - 1).
Real powerSlope(Real a, Real b, Real p) {
  const Real l = norm(a, b, p);
  return p == 1 ? 1 : l > 0 ? math::pow(a / l, p - 1) : 0;
}

Along<Real> norm(const Along<Real>& a, const Along<Real>& b, Real p) {
  const Real x = std::abs(a.value), y = std::abs(b.value);
  return {norm(x, y, p), std::copysign(powerSlope(x, y, p), a.value) * a.slope +
                             std::copysign(powerSlope(y, x, p), b.value) * b.slope};
}

/// Widened by more than the rounding of pow.
Interval loose(Real low, Real high) { return {low * (1 - gammaError(64)), high * (1 + gammaError(64))}; }

Along<Interval> norm(const Along<Interval>& a, const Along<Interval>& b, Real p) {
  const Interval x = abs(a.value), y = abs(b.value);
  const auto slope = [p](const Interval& along, const Interval& u, const Interval& v) {
    const Interval most = loose(powerSlope(u.low, v.high, p), powerSlope(u.high, v.low, p));
    if (along.low > 0) return most;
    if (along.high < 0) return -most;
    return Interval{-most.high, most.high};
  };
  return {loose(norm(x.low, y.low, p), norm(x.high, y.high, p)),
          slope(a.value, x, y) * a.slope + slope(b.value, y, x) * b.slope};
}

/// The tube's norm at o + d t, less its radius.
template <class T>
Along<T> tube(const Supertoroid& shape, const Vec3& o, const Vec3& d, T t) {
  const auto axis = [&](int i) { return Along<T>{T(o[i]) + t * T(d[i]), T(d[i])}; };
  Along<T> rho = norm(axis(0), axis(1), torusExponent(shape.east));
  rho.value = rho.value - T(std::abs(shape.majorRadius));
  Along<T> across = norm(rho, axis(2), torusExponent(shape.north));
  across.value = across.value - T(std::abs(shape.minorRadius));
  return across;
}

}  // namespace

void Supertoroid::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  const Span span = spanIn(roomy(bounds()), ray);
  if (span.empty()) return;
  const auto over = [&](const Interval& t) { return tube(*this, ray.origin, ray.direction, t); };
  const auto at = [&](Real t) {
    const Along<Real> a = tube(*this, ray.origin, ray.direction, t);
    return Jet{a.value, a.slope};
  };
  intervalCrossings(span, range, over, at, [&](Real t, bool) { visit(Crossing{t, 0}); });
}

SurfacePoint Supertoroid::surface(const Ray& ray, const Crossing& crossing) const {
  const Real R = std::abs(majorRadius), r = std::abs(minorRadius);
  const Real p = torusExponent(east), q = torusExponent(north);
  const Vec3 at = ray.at(crossing.t);
  const Real rho = norm(std::abs(at.x), std::abs(at.y), p), out = rho - R;
  // Back to the surface: across the tube, its norm made that of the radius.
  const Real across = norm(std::abs(out), std::abs(at.z), q), scale = across > 0 ? r / across : 1;
  const Real grow = rho > 0 ? (R + out * scale) / rho : 1;
  const Vec3 s{at.x * grow, at.y * grow, at.z * scale};
  const Real byRho = std::copysign(powerSlope(std::abs(out), std::abs(at.z), q), out);
  const Vec3 gradient{byRho * std::copysign(powerSlope(std::abs(at.x), std::abs(at.y), p), at.x),
                      byRho * std::copysign(powerSlope(std::abs(at.y), std::abs(at.x), p), at.y),
                      std::copysign(powerSlope(std::abs(at.z), std::abs(out), q), at.z)};
  const Real l = length(gradient);
  const Vec3 n = l > 0 ? gradient / l : normalize(-ray.direction);
  const Real error = (R + r) * gammaError(120);
  const Real v = 0.5 + math::atan2(at.z, out) / (2 * kPi);
  return {s, {error, error, error}, n, n, SurfaceUv::around(at, v)};
}

}  // namespace trace
