#include "geometry/shapes/surfaces/curves.h"

#include <algorithm>

#include "base/budget.h"
#include "base/error.h"
#include "geometry/solve/span.h"
#include "math/elementary.h"
#include "math/perpendicular.h"
#include "math/roots.h"

namespace trace {

std::shared_ptr<const TracedCurves> Curves::prepared() const {
  return std::make_shared<const TracedCurves>(strands, spline, round);
}

// --- strands and their pieces -----------------------------------------------------------------------------

namespace {

/// The Bezier ordinates of a cubic over a part of its interval.
std::array<Real, 4> hullOf(const Cubic<4>& curve, int axis, Real from, Real to) {
  const Real third = (to - from) / 3, first = curve.at(axis, from), last = curve.at(axis, to);
  return {first, first + curve.slope(axis, from) * third, last - curve.slope(axis, to) * third, last};
}

Vec3 curvePoint(const Cubic<4>& curve, Real u) { return {curve.at(0, u), curve.at(1, u), curve.at(2, u)}; }
Vec3 curveSlope(const Cubic<4>& curve, Real u) {
  return {curve.slope(0, u), curve.slope(1, u), curve.slope(2, u)};
}
Real curveBend(const Cubic<4>& curve, std::size_t axis, Real u) {
  return 2 * curve.c[axis][2] + 6 * u * curve.c[axis][3];
}
Vec3 curveBend(const Cubic<4>& curve, Real u) {
  return {curveBend(curve, 0, u), curveBend(curve, 1, u), curveBend(curve, 2, u)};
}

/// Points from one arc to the next, and points of an arc.
std::size_t pointsOn(Spline spline) { return spline == Spline::bezier ? 3 : 1; }
std::size_t pointsFor(Spline spline) { return spline == Spline::linear ? 2 : 4; }

Box3 curveBox(const Cubic<4>& curve, Real from, Real to) {
  Real radius = 0;
  for (const Real r : hullOf(curve, 3, from, to)) radius = max(radius, std::abs(r));
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = hullOf(curve, axis, from, to);
    const auto [least, most] = std::minmax_element(along.begin(), along.end());
    box.low[axis] = *least - radius;
    box.high[axis] = *most + radius;
  }
  return box;
}

}  // namespace

TracedCurves::TracedCurves(const std::vector<Strand>& strands, Spline spline, bool round)
    : spline_(spline), round_(round) {
  for (const Strand& strand : strands) {
    checkBudget();
    addStrand(strand);
  }
  first_.push_back(static_cast<std::uint32_t>(arcs_.size()));
  build();
}

void TracedCurves::addStrand(const Strand& strand) {
  const std::size_t step = pointsOn(spline_), reach = pointsFor(spline_);
  if (strand.size() < reach) return;
  const std::size_t firstPoint = points_.size(), count = (strand.size() - reach) / step + 1;
  if (firstPoint + strand.size() > kMostArcs)
    throw Error(Fault::scene, "curves: more than " + std::to_string(kMostArcs) + " points");
  bool finite = true;
  for (const auto& [x, y, z, width] : strand) {
    const std::array<float, 4> point{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z),
                                     static_cast<float>(std::abs(width) / 2)};
    for (const float number : point) finite = finite && std::isfinite(number);
    points_.push_back(point);
  }
  if (!finite) return points_.resize(firstPoint);
  first_.push_back(static_cast<std::uint32_t>(arcs_.size()));
  for (std::size_t i = 0; i < count; ++i)
    arcs_.push_back({static_cast<std::uint32_t>(firstPoint + i * step), i == 0, i + 1 == count});
}

Cubic<4> TracedCurves::cubicOf(std::size_t arc) const {
  const std::array<float, 4>* p = &points_[arcs_[arc].point];
  Cubic<4> cubic;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const Real a = p[0][axis], b = p[1][axis];
    cubic.c[axis] =
        spline_ == Spline::linear ? arcOf(spline_, a, b, 0, 0) : arcOf(spline_, a, b, p[2][axis], p[3][axis]);
  }
  return cubic;
}

/// Each arc is divided into as many pieces as make their boxes fit it well: at most four, and one where so
/// many arcs would take long to build.
void TracedCurves::build() {
  constexpr std::uint32_t kMostPieces = 4;
  constexpr std::size_t kMany = 2'000'000;  // pieces
  constexpr Real kSlender = 8;              // widths long
  Real length = 0, width = 0;
  for (std::size_t arc = 0; arc < arcs_.size(); ++arc) {
    const Cubic<4> curve = cubicOf(arc);
    length += trace::length(curvePoint(curve, 1) - curvePoint(curve, 0));
    width += 2 * std::abs(curve.at(3, 0.5));
  }
  while (pieces_ < kMostPieces && length > kSlender * width * pieces_ && 2 * pieces_ * arcs_.size() <= kMany)
    pieces_ *= 2;

  std::vector<Box3> boxes;
  boxes.reserve(arcs_.size() * pieces_);
  for (std::size_t arc = 0; arc < arcs_.size(); ++arc) {
    checkBudget();
    const Cubic<4> curve = cubicOf(arc);
    for (std::uint32_t i = 0; i < pieces_; ++i) {
      boxes.push_back(curveBox(curve, Real(i) / pieces_, Real(i + 1) / pieces_));
      bounds_.extend(boxes.back());
    }
  }
  error_ = bounds_.empty() ? 0 : maxComponent(max(abs(bounds_.low), abs(bounds_.high))) * gammaError(64);
  for (Box3& box : boxes) box = roomy(box);
  bvh_ = Bvh(boxes, Bvh::Leaves::single, 0);
}

std::vector<TracedCurves::Strand> TracedCurves::drawn(std::size_t most) const {
  const std::size_t count = first_.size() - 1, shown = std::min(count, most);
  const int steps = spline_ == Spline::linear ? 1 : 3;  // on each arc
  std::vector<Strand> strands;
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t number = i * count / shown;
    Strand strand;
    const auto add = [&](const Cubic<4>& curve, Real u) {
      strand.push_back({curve.at(0, u), curve.at(1, u), curve.at(2, u), std::abs(curve.at(3, u))});
    };
    for (std::uint32_t arc = first_[number]; arc < first_[number + 1]; ++arc) {
      const Cubic<4> curve = cubicOf(arc);
      if (strand.empty()) add(curve, 0);
      for (int k = 1; k <= steps; ++k) add(curve, Real(k) / steps);
    }
    strands.push_back(std::move(strand));
  }
  return strands;
}

// --- rays -------------------------------------------------------------------------------------------------

/// An arc as the ray sees it: x and y across the ray, z along it from `shift` on, and the radius.
struct TracedCurves::Across {
  std::array<Real, 4> x, y, z, r;
  Real shift;

  struct At {
    Real value, slope, bend;
  };
  static At at(const std::array<Real, 4>& c, Real u) {
    return {c[0] + u * (c[1] + u * (c[2] + u * c[3])), c[1] + u * (2 * c[2] + u * 3 * c[3]),
            2 * c[2] + 6 * u * c[3]};
  }

  /// Whether the ray misses the sphere of every point from u = from to u = to, by the hull of the points.
  bool misses(Real from, Real to) const {
    const Real third = (to - from) / 3;
    std::array<std::array<Real, 4>, 3> p;
    std::size_t axis = 0;
    for (const auto* c : {&x, &y, &r}) {
      const At a = at(*c, from), b = at(*c, to);
      p[axis++] = {a.value, a.value + a.slope * third, b.value - b.slope * third, b.value};
    }
    const Real radius =
        max(max(std::abs(p[2][0]), std::abs(p[2][1])), max(std::abs(p[2][2]), std::abs(p[2][3])));
    const Real dx = p[0][3] - p[0][0], dy = p[1][3] - p[1][0],
               room = radius * std::sqrt(dx * dx + dy * dy) * (1 + 0x1p-40);
    if (!(room > 0)) return false;
    Real least[2] = {kInfinity, kInfinity}, most[2] = {-kInfinity, -kInfinity};
    for (std::size_t i = 0; i < 4; ++i) {
      const Real off[2] = {dx * p[1][i] - dy * p[0][i], dx * p[0][i] + dy * p[1][i]};
      for (int k = 0; k < 2; ++k) least[k] = min(least[k], off[k]), most[k] = max(most[k], off[k]);
    }
    return least[0] > room || most[0] < -room || least[1] > room || most[1] < -room;
  }

  /// D(u) from the radius and the distance, which keeps its digits where both are nearly the same.
  Real inside(Real u) const {
    const Real a = at(x, u).value, b = at(y, u).value, radius = std::abs(at(r, u).value),
               far = std::sqrt(a * a + b * b);
    return (radius - far) * (radius + far);
  }
  /// z - sqrt(D).
  Real entry(Real u) const { return shift + at(z, u).value - std::sqrt(max(0, inside(u))); }
  /// Its sign is that of the slope of entry().
  Jet rise(Real u) const {
    const At a = at(x, u), b = at(y, u), c = at(z, u), d = at(r, u);
    const Real root = std::sqrt(max(0, inside(u)));
    const Real slope = 2 * (d.value * d.slope - a.value * a.slope - b.value * b.slope);
    const Real bend = 2 * (d.slope * d.slope + d.value * d.bend - a.slope * a.slope - a.value * a.bend -
                           b.slope * b.slope - b.value * b.bend);
    return {2 * c.slope * root - slope, 2 * c.bend * root + (root > 0 ? c.slope * slope / root : 0) - bend};
  }
};

/// A query of a ray: its space, and what is visited.
struct TracedCurves::Search {
  const TracedCurves& curves;
  const Ray& ray;
  const VisitCrossing& visit;
  Real speed;
  Vec3 along, aside, third;

  Search(const TracedCurves& all, const Ray& r, const VisitCrossing& v)
      : curves(all),
        ray(r),
        visit(v),
        speed(length(r.direction)),
        along(r.direction / speed),
        aside(perpendicularTo(along)),
        third(cross(along, aside)) {}

  Across across(std::size_t arc) const {
    const Cubic<4> curve = curves.cubicOf(arc);
    Across a;
    // Around the point of the ray nearest the arc's middle, where distances keep their digits.
    a.shift = dot(curvePoint(curve, 0.5) - ray.origin, along);
    const Vec3 o = ray.origin + along * a.shift;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 c{curve.c[0][i], curve.c[1][i], curve.c[2][i]}, v = i == 0 ? c - o : c;
      a.x[i] = dot(v, aside);
      a.y[i] = dot(v, third);
      a.z[i] = dot(v, along);
      a.r[i] = curve.c[3][i];
    }
    return a;
  }

  void found(std::size_t arc, Real u, Real s) {
    constexpr std::int64_t kLast = (1 << kStepBits) - 1;
    const std::int64_t inner = std::clamp<std::int64_t>(std::llround(std::ldexp(u, kStepBits)), 1, kLast - 1);
    const std::int64_t step = u == 0 ? 0 : u == 1 ? kLast : inner;
    visit(Crossing{s / speed, (static_cast<std::int64_t>(arc) << kStepBits) + step});
  }

  void piece(std::uint32_t number) {
    const std::size_t arc = number / curves.pieces_;
    const Real from = Real(number % curves.pieces_) / curves.pieces_,
               to = Real(number % curves.pieces_ + 1) / curves.pieces_;
    const Across a = across(arc);
    if (a.misses(from, to)) return;
    curves.round_ ? tube(arc, a, from, to) : ribbon(arc, a, from, to);
  }

  void tube(std::size_t arc, const Across& a, Real from, Real to) {
    std::array<Real, 7> d{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) d[i + k] += a.r[i] * a.r[k] - a.x[i] * a.x[k] - a.y[i] * a.y[k];
    const Nodes ends = rootsWithEnds(d, from, to);
    for (std::size_t i = 0; i + 1 < ends.count; ++i) {
      const Real u0 = ends.at[i], u1 = ends.at[i + 1];
      if (!(evaluate(d, 0.5 * (u0 + u1)).value > 0)) continue;
      // The entry falls without bound at the beginning of an interval, and rises so at its end.
      const bool falls = i > 0 || a.rise(u0).value < 0, rises = i + 2 < ends.count || !(a.rise(u1).value < 0);
      if (falls && rises) {
        const Real u = rootBetween([&](Real at) { return a.rise(at); }, u0, u1, true);
        found(arc, u, a.entry(u));
      }
      if (!falls && u0 == 0 && curves.arcs_[arc].begins) found(arc, 0, a.entry(0));
      if (!rises && u1 == 1 && (curves.arcs_[arc].ends || !(across(arc + 1).rise(0).value < 0)))
        found(arc, 1, a.entry(1));
    }
  }

  void ribbon(std::size_t arc, const Across& a, Real from, Real to) {
    std::array<Real, 6> g{};  // half the slope of the squared distance
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 1; k < 4; ++k)
        g[i + k - 1] += static_cast<Real>(k) * (a.x[i] * a.x[k] + a.y[i] * a.y[k]);
    const Nodes nodes = rootsWithEnds(g, from, to);
    for (std::size_t i = 1; i + 1 < nodes.count; ++i) {
      const Real u = nodes.at[i];
      const bool nearest = evaluate(g, 0.5 * (nodes.at[i - 1] + u)).value < 0;
      if (nearest && a.inside(u) >= 0 && !startsWithin(a, u))
        found(arc, u, a.shift + Across::at(a.z, u).value);
    }
  }

  /// A ribbon turns to each ray. One that starts on the strand does not meet it again there, as if it came
  /// out of a tube; but it does at its very start.
  bool startsWithin(const Across& a, Real u) const {
    constexpr Real kWidths = 8;  // how far along the strand
    const Across::At x = Across::at(a.x, u), y = Across::at(a.y, u), z = Across::at(a.z, u);
    const Real s = a.shift + z.value, radius = std::abs(Across::at(a.r, u).value) * (1 + 0x1p-30);
    if (std::abs(s) <= curves.error_ * 0x1p16) return false;
    const Vec3 way{x.value, y.value, s}, tangent{x.slope, y.slope, z.slope};
    const Vec3 off = cross(way, tangent);
    return dot(way, way) <= kWidths * kWidths * radius * radius &&
           dot(off, off) <= radius * radius * dot(tangent, tangent);
  }
};

void TracedCurves::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  if (bounds_.empty()) return;
  const Span span = spanIn(roomy(bounds_), ray);
  if (span.empty()) return;
  // The hierarchy looks ahead only: it is asked from a place before everything that is wanted.
  const Real back = max(range.from, span.from - 0.5 * (span.to - span.from)),
             start = range.from >= 0 ? 0 : back;
  Real most = range.to - start;
  Search search(*this, ray, visit);
  NodeCount visited;
  bvh_.query(start == 0 ? ray.origin : ray.at(start), ray.direction, most, true, visited,
             [&](std::uint32_t number) {
               checkBudget();
               search.piece(number);
               most = range.to - start;
               return false;
             });
}

// --- places -----------------------------------------------------------------------------------------------

Real TracedCurves::pathOf(std::size_t arc, Real u) const {
  const auto next = std::upper_bound(first_.begin(), first_.end(), static_cast<std::uint32_t>(arc));
  const std::uint32_t first = *(next - 1), count = *next - first;
  return (static_cast<Real>(arc - first) + u) / count;
}

SurfacePoint TracedCurves::surface(const Ray& ray, const Crossing& crossing) const {
  const auto arc = static_cast<std::size_t>(crossing.part >> kStepBits);
  const Cubic<4> curve = cubicOf(arc);
  constexpr std::int64_t kLast = (1 << kStepBits) - 1;
  const std::int64_t step = crossing.part & kLast;
  const bool end = step == 0 || step == kLast;
  const Vec3 p = ray.at(crossing.t), along = normalize(ray.direction);
  Real u = step == kLast ? 1 : std::ldexp(static_cast<Real>(step), -kStepBits);
  // On the sphere that touches the tube here, or at the point of the curve that the ray passes nearest.
  for (int i = 0; i < 8 && !end; ++i) {
    const Vec3 c = curvePoint(curve, u), slope = curveSlope(curve, u), bend = curveBend(curve, u);
    Real value, change;
    if (round_) {
      const Real r = curve.at(3, u), dr = curve.slope(3, u), ddr = curveBend(curve, 3, u);
      value = dot(p - c, slope) + r * dr;
      change = dot(p - c, bend) - dot(slope, slope) + dr * dr + r * ddr;
    } else {
      const Vec3 off = p - c, across = slope - along * dot(slope, along);
      value = dot(off, across);
      change = dot(off, bend - along * dot(bend, along)) - dot(across, across);
    }
    const Real next = u - value / change;
    constexpr Real kNear = 1e-2;  // places beside the one that was found are asked for, too
    if (!(std::abs(next - u) < kNear)) break;
    const Real before = u;
    u = std::clamp(next, 0.0, 1.0);
    if (std::abs(u - before) < 0x1p-50) break;
  }
  SurfacePoint s = round_ ? onTube(p, along, curve, u) : onRibbon(p, along, curve, u);
  s.uv = {pathOf(arc, u), Vec2(s.uv).y};
  if (dot(s.normal, ray.direction) > 0) s.normal = s.shading = -s.normal;
  return s;
}

SurfacePoint TracedCurves::onTube(const Vec3& p, const Vec3& along, const Cubic<4>& curve, Real u) const {
  const Vec3 c = curvePoint(curve, u);
  Vec3 n = normalize(p - c);
  if (!isFinite(n)) n = -along;
  const Vec3 tangent = normalize(curveSlope(curve, u));
  const Vec3 side = isFinite(tangent) ? perpendicularTo(tangent) : Vec3{1, 0, 0};
  const Real angle = math::atan2(dot(n, cross(tangent, side)), dot(n, side));
  const Real around = std::isfinite(angle) ? 0.5 + angle / (2 * kPi) : 0.5;
  return {c + n * std::abs(curve.at(3, u)), {error_, error_, error_}, n, n, {0, around}};
}

/// The ribbon is the surface of the points c(u) + s N(u), where N is at right angles to the ray and the
/// curve.
SurfacePoint TracedCurves::onRibbon(const Vec3& p, const Vec3& along, const Cubic<4>& curve, Real u) const {
  const Vec3 c = curvePoint(curve, u), slope = curveSlope(curve, u), bend = curveBend(curve, u);
  const Real radius = std::abs(curve.at(3, u)), ahead = dot(slope, along);
  const Vec3 across = slope - along * ahead;
  const Real size = length(across);
  const Vec3 e = size > 0 ? across / size : perpendicularTo(along), side = cross(along, e);
  const Real s = std::clamp(dot(p - c, side), -radius, radius);
  const Real grows = size > 0 ? size - s * dot(bend, side) / size : 1;
  Vec3 n = normalize(e * ahead - along * grows);
  if (!isFinite(n)) n = -along;
  return {c + side * s, {error_, error_, error_}, n, n, {0, radius > 0 ? 0.5 + 0.5 * s / radius : 0.5}};
}

}  // namespace trace
