#include "geometry/shapes/fractals/julia.h"

#include <algorithm>

#include "accel/bvh.h"
#include "geometry/solve/interval_search.h"
#include "math/elementary.h"

namespace trace {

// Compiled from julia_kernel.h, each in its own file with its own flags.
#if defined(TRACE_HAS_AVX2)
extern const JuliaKernel kJuliaKernelAvx2;
#endif
extern const JuliaKernel kJuliaKernelBase;

std::span<const JuliaKernel> juliaKernels() {
#if defined(TRACE_HAS_AVX2)
  static const std::array<JuliaKernel, 2> kAll{kJuliaKernelAvx2, kJuliaKernelBase};
  return std::span(kAll).subspan(hasAvx2() ? 0 : 1);
#else
  return {&kJuliaKernelBase, 1};
#endif
}

namespace {

using Number = std::array<Real, 4>;

Number operator+(const Number& a, const Number& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
Number operator*(const Number& a, Real s) { return {a[0] * s, a[1] * s, a[2] * s, a[3] * s}; }
Real dot(const Number& a, const Number& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }
Real size(const Number& a) { return std::sqrt(dot(a, a)); }

julia::Number<Real> named(const Number& q) { return {q[0], q[1], q[2], q[3]}; }
Number numbered(const julia::Number<Real>& q) { return {q.a, q.i, q.j, q.k}; }

/// Calls f with the iteration, a power, as a constant.
template <class F>
decltype(auto) withPower(Iteration iteration, F&& f) {
  switch (iteration) {
    case Iteration::cube: return f.template operator()<Iteration::cube>();
    case Iteration::hypercomplex: return f.template operator()<Iteration::hypercomplex>();
    default: return f.template operator()<Iteration::square>();
  }
}

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

std::string Julia::excess() const {
  const int most = mostIterations();
  if (iterations <= most || iterations > JuliaSet::kMostIterations) return {};
  const std::string bound = std::to_string(most);
  return "iterations of julia: numbers can follow a " +
         std::string(names(iteration)[static_cast<std::size_t>(iteration)]) + " " + bound + " times, found " +
         std::to_string(iterations) + "; " + bound + " are used";
}

std::shared_ptr<const TracedJulia> Julia::prepared() const {
  return std::make_shared<const TracedJulia>(*this);
}

TracedJulia::TracedJulia(const Julia& shape, const JuliaKernel& kernel) : shape_(shape) {
  shape_.iterations = std::clamp(shape.iterations, 1, shape.mostIterations());
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
  reach_ = kReach * (1 + std::ldexp(1.0, -40));
  if (!power()) return;
  findLimits();
  look_ = shape_.iteration == Iteration::square ? kernel.square
          : shape_.iteration == Iteration::cube ? kernel.cube
                                                : kernel.hypercomplex;
}

/// Sizes from which a number surely escapes, and with them the ball that holds the set.
void TracedJulia::findLimits() {
  const Real c = size(shape_.constant);
  // With q = c at the first step, |c| > 2.57 takes the second beyond 4.
  const Real widest = shape_.iterations == 1 ? kEscaped : 2.57;
  set_.constant = named(shape_.constant);
  set_.share = shape_.mandelbrot ? 1 : 0;
  set_.mostConstant = shape_.mandelbrot ? widest + 2 * c : c;
  set_.mostGrowth = mostGrowth();
  const int n = set_.iterations = shape_.iterations;
  constexpr Real kRounding = 1 + gammaError(64);
  set_.escapes[n] = set_.stays[n] = kEscaped;
  for (int i = n; i-- > 0;) {
    const Real next = set_.escapes[i + 1] + set_.mostConstant;
    set_.escapes[i] = (shape_.iteration == Iteration::cube ? math::cbrt(next) : std::sqrt(next)) * kRounding;
    const Real left = max(set_.stays[i + 1] - set_.mostConstant, 0) /
                      (shape_.iteration == Iteration::hypercomplex ? julia::kStretch : 1);
    set_.stays[i] = (shape_.iteration == Iteration::cube ? math::cbrt(left) : std::sqrt(left)) / kRounding;
  }
  const Real all = (shape_.mandelbrot ? widest + c : set_.escapes[0]) * (1 + std::ldexp(1.0, -30));
  reach_ = set_.reach = std::sqrt(max(all * all - dot(shift_, shift_), 0));
}

TracedJulia::Number TracedJulia::lift(const Vec3& p) const {
  return axes_[0] * p.x + axes_[1] * p.y + axes_[2] * p.z + shift_;
}

TracedJulia::Number TracedJulia::step(const Number& q) const {
  switch (shape_.iteration) {
    case Iteration::sine: {
      const Polar p = polar(q);
      const auto [s, c] = math::sincos(p.a);
      return composed(s * math::cosh(p.b), p.n * (c * math::sinh(p.b)));
    }
    case Iteration::exponential: {
      const Polar p = polar(q);
      const auto [s, c] = math::sincos(p.b);
      const Real size = math::exp(p.a);
      return composed(size * c, p.n * (size * s));
    }
    default:
      return withPower(shape_.iteration, [&]<Iteration kIteration>() {
        return numbered(julia::step<kIteration>(named(q), dot(q, q)));
      });
  }
}

TracedJulia::Number TracedJulia::stepSlope(const Number& q, const Number& d) const {
  switch (shape_.iteration) {
    case Iteration::sine: {
      const Polar p = polar(q);
      const auto [s, c] = math::sincos(p.a);
      const Real ch = math::cosh(p.b), sh = math::sinh(p.b);
      return functionSlope(p, c * sh, c * ch, -s * sh, d);
    }
    case Iteration::exponential: {
      const Polar p = polar(q);
      const auto [s, c] = math::sincos(p.b);
      const Real a = math::exp(p.a) * c, b = math::exp(p.a) * s;
      return functionSlope(p, b, a, b, d);
    }
    default:
      return withPower(shape_.iteration, [&]<Iteration kIteration>() {
        return numbered(julia::slope<kIteration>(named(q), named(d), dot(q, q), dot(q, d)));
      });
  }
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
    case Iteration::sine: return math::cosh(polar(q).b + r);
    case Iteration::exponential: return math::exp(q[0] + r);
    default:
      return withPower(shape_.iteration,
                       [&]<Iteration kIteration>() { return julia::stretch<kIteration>(s); });
  }
}

Jet TracedJulia::functionValue(const Vec3& p, const Vec3& direction) const {
  const Number start = lift(p), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  const Number along = axes_[0] * direction.x + axes_[1] * direction.y + axes_[2] * direction.z;
  Number q = shape_.mandelbrot ? Number{} : start, d = shape_.mandelbrot ? Number{} : along;
  const Real l = length(p);
  Jet most{l - kReach, l > 0 ? dot(p, direction) / l : 0};
  Real growth = shape_.mandelbrot ? 0 : 1;
  for (int i = 0; i < shape_.iterations; ++i) {  // to the last: only so it is continuous
    growth = grown(growth, q, 0);
    if (isBlurred(growth, i)) break;
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
  Real growth = shape_.mandelbrot ? 0 : 1;
  for (int i = 0; i < shape_.iterations; ++i) {
    growth = grown(growth, q, r);
    if (isBlurred(growth, i)) return {-1, 1};  // for some places of the ball the number before is the last
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

template <Iteration kIteration>
Jet TracedJulia::powerValue(const Vec3& p, const Vec3& direction) const {
  const julia::Number<Real> start = named(lift(p));
  const julia::Number<Real> along =
      named(axes_[0] * direction.x + axes_[1] * direction.y + axes_[2] * direction.z);
  const Real share = set_.share;
  const julia::Number<Real> c = set_.constant + start * share, more = along * share;
  julia::Number<Real> q = start * (1 - share), d = along * (1 - share);
  Real growth = 1 - share;
  for (int i = 0;; ++i) {
    const Real square = dot(q, q), product = dot(q, d);
    growth = growth * julia::stretch<kIteration>(std::sqrt(square)) + share;
    if (i == set_.iterations || (i >= JuliaSet::kSurely && growth > set_.mostGrowth))
      return {square - set_.escapes[i] * set_.escapes[i], 2 * product};
    if (i > 0 && square > kEscaped * kEscaped) return {1, 0};
    d = julia::slope<kIteration>(q, d, square, product) + more;
    q = julia::step<kIteration>(q, square) + c;
  }
}

Jet TracedJulia::value(const Vec3& p, const Vec3& direction) const {
  if (!power()) return functionValue(p, direction);
  return withPower(shape_.iteration,
                   [&]<Iteration kIteration>() { return powerValue<kIteration>(p, direction); });
}

void TracedJulia::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  const Vec3& direction = ray.direction;
  const Real a = dot(direction, direction), b = dot(ray.origin, direction);
  const Vec3 nearest = ray.origin - direction * (b / a);
  const Roots2 ball = solveQuadratic(a, b, dot(ray.origin, ray.origin) - reach_ * reach_,
                                     a * (reach_ * reach_ - dot(nearest, nearest)));
  if (!ball.count) return;
  const Real speed = std::sqrt(a);
  const auto at = [&](Real t) { return value(ray.at(t), direction); };
  const auto found = [&](Real t, bool) {
    visit(Crossing{t, shape_.materials.empty() ? 0 : TrapPart::part(0, trapUv(ray.at(t)).x)});
  };
  if (power()) {
    const Number origin = lift(ray.origin);
    const Number unit = axes_[0] * (direction.x / speed) + axes_[1] * (direction.y / speed) +
                        axes_[2] * (direction.z / speed);
    const auto look = [&](Real t, Real half) {
      return look_(set_, named(origin + unit * (t * speed)), named(unit), half * speed);
    };
    return stretchCrossings({ball.t0, ball.t1}, range, kPowerStep * reach_ / speed, look, at, found);
  }
  // Functions fold space everywhere: looking as closely as at powers would take seconds.
  const auto bounds = [&](const Interval& t) {
    const Real radius = 0.5 * (t.high - t.low) * speed * (1 + gammaError(8));
    return Along<Interval>{functionSigns(ray.at(0.5 * (t.low + t.high)), radius), Interval::everything()};
  };
  intervalCrossings<14, false>({ball.t0, ball.t1}, range, bounds, at, found);
}

SurfacePoint TracedJulia::surface(const Ray& ray, const Crossing& crossing) const {
  const Vec3 p = ray.at(crossing.t);
  const Number start = lift(p), c = shape_.mandelbrot ? start + shape_.constant : shape_.constant;
  Number q = shape_.mandelbrot ? Number{} : start;
  std::array<Number, 3> by = axes_;
  if (shape_.mandelbrot) by = {};
  Real off = gammaError(8) * (length(p) + size(shift_));  // how far rounding has moved q
  // In the sets of powers the last number tells how the surface lies, in others that which passes the limit
  // most.
  Real most = length(p) - kReach, error = off, growth = shape_.mandelbrot ? 0 : 1;
  bool blurred = false;
  Vec3 gradient = p;
  for (int i = 0; i < shape_.iterations; ++i) {
    growth = grown(growth, q, 0);
    if ((blurred = isBlurred(growth, i))) break;
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
      most = excess;
      error = off;
      gradient = {escapeSlope(q, by[0]), escapeSlope(q, by[1]), escapeSlope(q, by[2])};
    }
    if (!(excess <= 0)) break;
  }
  const Real l = length(gradient);
  const Vec3 n = l > 0 && std::isfinite(l) ? gradient / l : normalize(-ray.direction);
  constexpr Real kMost = 1e-9;  // where the set is too folded for rounding to tell
  // This crossing and that of a ray that starts here are each found by a value that is off by so much.
  Real e = min(4 * error / l, kMost) + maxComponent(abs(p)) * gammaError(8);
  if (blurred) e += kReach * detail() / 16;
  const SurfaceUv uv = shape_.trap == Trap::none ? SurfaceUv::toward(normalize(p)) : SurfaceUv(trapUv(p));
  return {p, {e, e, e}, n, n, uv};
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
