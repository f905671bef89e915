#include "geometry/shapes/surfaces/sphere_sweep.h"

#include <algorithm>

#include "base/small_list.h"
#include "math/elementary.h"

namespace trace {
namespace {

/// The product of two polynomials, lowest powers first.
template <std::size_t N, std::size_t M>
std::array<Real, N + M - 1> operator*(const std::array<Real, N>& a, const std::array<Real, M>& b) {
  std::array<Real, N + M - 1> product{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < M; ++j) product[i + j] += a[i] * b[j];
  return product;
}
template <std::size_t N>
std::array<Real, N - 1> derivative(const std::array<Real, N>& a) {
  std::array<Real, N - 1> result{};
  for (std::size_t i = 1; i < N; ++i) result[i - 1] = static_cast<Real>(i) * a[i];
  return result;
}

/// Without its highest powers, as far as they are zero: of straight arcs most are.
std::span<const Real> needed(std::span<const Real> coefficients) {
  std::size_t n = coefficients.size();
  while (n > 1 && coefficients[n - 1] == 0) --n;
  return coefficients.first(n);
}

/// Least and greatest value of a cubic for u from 0 to 1: between its Bezier ordinates.
Span hull(const std::array<Real, 4>& c) {
  const Real ordinates[] = {c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, c[0] + c[1] + c[2] + c[3]};
  const auto [least, most] = std::minmax_element(std::begin(ordinates), std::end(ordinates));
  return {*least, *most};
}

Vec3 perpendicular(const Vec3& v, const Vec3& wanted) {
  const Vec3 p = wanted - v * (dot(wanted, v) / dot(v, v));
  const Real l = length(p);
  return l > 0 && std::isfinite(l) ? p / l : wanted;
}

}  // namespace

std::shared_ptr<const TracedSweep> SphereSweep::prepared() const {
  return std::make_shared<const TracedSweep>(arcsOf<4>(spline, points).arcs);
}

TracedSweep::TracedSweep(const std::vector<Cubic<4>>& curves) {
  std::vector<Box3> boxes;
  for (const Cubic<4>& curve : curves) {
    Box3 box;
    const Span radius = hull(curve.c[3]);
    const Real r = max(std::abs(radius.from), std::abs(radius.to));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Span reach = hull(curve.c[axis]);
      box.low[static_cast<int>(axis)] = reach.from - r;
      box.high[static_cast<int>(axis)] = reach.to + r;
    }
    arcs_.push_back({curve, {}});
    const Vec3 along = arcs_.back().slope(0);
    const Vec3 least = std::abs(along.z) <= std::abs(along.x) || std::abs(along.z) <= std::abs(along.y)
                           ? Vec3{0, 0, 1}
                           : Vec3{1, 0, 0};
    arcs_.back().across = perpendicular(along, arcs_.size() > 1 ? arcs_[arcs_.size() - 2].across : least);
    boxes.push_back(box);
    bounds_.extend(box);
  }
  error_ = bounds_.empty() ? 0 : maxComponent(max(abs(bounds_.low), abs(bounds_.high))) * gammaError(64);
  tree_ = LineTree(std::move(boxes));
}

namespace {
/// An end of a stretch: where on the line, and which sphere it touches.
struct Touch {
  Real t = kInfinity, u = 0;
};
}  // namespace

/// A stretch of the line inside the sweep, and where its ends touch.
struct TracedSweep::Reach {
  Crossing in, out;
};

void TracedSweep::crossings(const Ray& ray, VisitCrossing visit) const {
  const Vec3& d = ray.direction;
  const Real speed = length(d);
  const Vec3 along = d / speed;
  SmallList<Reach, 16> found;
  tree_.query(ray, [&](std::uint32_t number) {
    const Arc& arc = arcs_[number];
    // Around the point of the ray nearest the arc's middle, where distances keep their digits.
    const Vec3 o = ray.origin + along * dot(arc.at(0.5) - ray.origin, along);
    std::array<std::array<Real, 4>, 3> w;  // the path across the ray
    std::array<Real, 4> b{};               // and along it
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 c{arc.curve.c[0][i], arc.curve.c[1][i], arc.curve.c[2][i]};
      const Vec3 v = i == 0 ? c - o : c;
      b[i] = dot(v, along);
      const Vec3 side = v - along * b[i];
      w[0][i] = side.x;
      w[1][i] = side.y;
      w[2][i] = side.z;
    }
    const auto& r = arc.curve.c[3];
    std::array<Real, 7> D = r * r;
    for (const auto& axis : w) {
      const auto square = axis * axis;
      for (std::size_t i = 0; i < 7; ++i) D[i] -= square[i];
    }
    const auto bSlope = derivative(b);
    const auto DSlope = derivative(D);
    auto turns = DSlope * DSlope;  // b'^2 4 D = D'^2
    const auto other = (bSlope * bSlope) * D;
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] -= 4 * other[i];

    // From the ray's own origin and without cancellation: the sphere at u.
    const auto sphere = [&](Real u, bool touching) {
      const Vec3 v = ray.origin - arc.at(u);
      const Real radius = arc.radius(u), middle = dot(v, along);
      const Real c = dot(v, v) - radius * radius;
      // Which way to the discriminant keeps its digits depends on how far away the ray begins.
      const Vec3 side = v - along * middle;
      const bool near = std::abs(middle) < radius;
      const Real square = near ? middle * middle - c : radius * radius - dot(side, side);
      if (!(square > 0)) return touching ? Roots2{2, -middle, -middle} : Roots2{};
      return solveQuadratic(1, middle, c, square);
    };
    const Nodes ends = rootsWithEnds(needed(D), 0, 1);
    for (std::size_t i = 0; i + 1 < ends.count; ++i) {
      const Real u0 = ends.at[i], u1 = ends.at[i + 1];
      if (!(evaluate(D, 0.5 * (u0 + u1)).value > 0)) continue;
      Touch in, out{-kInfinity, 0};
      const auto consider = [&](Real u, bool touching) {
        const Roots2 t = sphere(u, touching);
        if (!t.count) return;
        if (t.t0 < in.t) in = {t.t0, u};
        if (t.t1 > out.t) out = {t.t1, u};
      };
      for (const Nodes& nodes : {rootsWithEnds(needed(turns), u0, u1), rootsWithEnds(needed(DSlope), u0, u1)})
        for (std::size_t n = 0; n < nodes.count; ++n) consider(nodes.at[n], true);
      // The polynomials are not exact enough for grazing rays: Newton's steps on what they stand for,
      // D' -+ 2 b' sqrt(D) = 0, which falls around each extreme; halving where one leaves. A polynomial that
      // is nearly nothing leaves u0 and u1 uncertain by its root.
      const Real margin = std::sqrt(error_);
      for (const Real side : {-1.0, 1.0}) {
        Real u = side < 0 ? in.u : out.u, low = max(0, u0 - margin), high = min(1, u1 + margin);
        for (int step = 0; step < 64; ++step) {
          const Roots2 t = sphere(u, true);
          const Real root = 0.5 * (t.t1 - t.t0);
          const Jet slope = evaluate(DSlope, u), rise = evaluate(bSlope, u);
          const Real f = slope.value + side * 2 * rise.value * root;
          const Real g = slope.slope + side * (2 * rise.slope * root + rise.value * slope.value / root);
          (f > 0 ? low : high) = u;
          Real next = u - f / g;
          if (!(low < next && next < high)) next = 0.5 * (low + high);  // also if it is no number
          if (std::abs(next - u) < gammaError(64)) break;
          consider(u = next, false);
        }
      }
      const auto part = [&](Real u) {
        constexpr std::int64_t kLast = (1 << kStepBits) - 1;
        const std::int64_t inner =
            std::clamp<std::int64_t>(std::llround(std::ldexp(u, kStepBits)), 1, kLast - 1);
        return (static_cast<std::int64_t>(number) << kStepBits) + (u == 0 ? 0 : u == 1 ? kLast : inner);
      };
      found.add({{in.t, part(in.u)}, {out.t, part(out.u)}});
    }
  });
  std::span<Reach> all = found.all();
  std::sort(all.begin(), all.end(), [](const Reach& a, const Reach& b) { return a.in.before(b.in); });
  for (std::size_t i = 0; i < all.size();) {
    Crossing out = all[i].out;
    std::size_t next = i + 1;
    for (; next < all.size() && all[next].in.t <= out.t; ++next)
      if (all[next].out.t > out.t) out = all[next].out;
    visit({all[i].in.t / speed, all[i].in.part});
    visit({out.t / speed, out.part});
    i = next;
  }
}

SurfacePoint TracedSweep::surface(const Ray& ray, const Crossing& crossing) const {
  const Vec3 p = ray.at(crossing.t);
  const auto number = static_cast<std::size_t>(crossing.part >> kStepBits);
  const Arc& arc = arcs_[number];
  constexpr std::int64_t kLast = (1 << kStepBits) - 1;
  const std::int64_t step = crossing.part & kLast;
  Real u = step == kLast ? 1 : std::ldexp(static_cast<Real>(step), -kStepBits);
  if (step != 0 && step != kLast) {
    // On the sphere that touches the surface here: (p - C) . C' + r r' = 0.
    for (int i = 0; i < 3; ++i) {
      const auto f = [&](Real at) {
        return dot(p - arc.at(at), arc.slope(at)) + arc.curve.at(3, at) * arc.curve.slope(3, at);
      };
      const Real h = std::ldexp(1.0, -kStepBits), value = f(u), slope = (f(u + h) - f(u - h)) / (2 * h);
      const Real next = u - value / slope;
      constexpr Real kNear = 1e-2;  // places beside the one that was found are asked for, too
      if (!(std::abs(next - u) < kNear)) break;
      u = std::clamp(next, 0.0, 1.0);
    }
  }
  const Vec3 c = arc.at(u), v = p - c, n = normalize(v);
  const Vec3 slope = arc.slope(u);
  const Vec3 side = perpendicular(slope, arc.across);
  const Real angle = math::atan2(dot(n, cross(slope, side)) / max(length(slope), 1e-300), dot(n, side));
  const Real path = (static_cast<Real>(number) + u) / static_cast<Real>(arcs_.size());
  return {c + n * arc.radius(u), {error_, error_, error_}, n, n, {path, 0.5 + angle / (2 * kPi)}};
}

}  // namespace trace
