#include "geometry/shapes/surfaces/lathe.h"

#include <algorithm>

#include "math/near_root.h"

namespace trace {

std::shared_ptr<const TracedLathe> Lathe::prepared() const {
  return std::make_shared<const TracedLathe>(*this);
}

TracedLathe::TracedLathe(const Lathe& shape) : solid_(shape.capped) {
  const Arcs<2> curve = arcsOf<2>(shape.spline, shape.profile);
  if (curve.arcs.empty()) return;
  const auto &first = curve.ends.front(), &last = curve.ends.back();
  const auto straight = [&](const std::array<Real, 2>& a, const std::array<Real, 2>& b) {
    add({{{{a[0], b[0] - a[0], 0, 0}, {a[1], b[1] - a[1], 0, 0}}}}, a, b);
  };
  const bool closed = first == last;
  if (closed) solid_ = true;
  const bool caps = shape.capped && !closed;
  if (caps && first[0] != 0) straight({0, first[1]}, first);
  for (std::size_t i = 0; i < curve.arcs.size(); ++i) add(curve.arcs[i], curve.ends[i], curve.ends[i + 1]);
  if (caps && last[0] != 0) straight(last, {0, last[1]});

  // Twice the area of the half section, counter-clockwise positive: then outside is to the right.
  Real area = caps ? last[0] * last[1] - first[0] * first[1] : 0;
  for (const Cubic<2>& arc : curve.arcs) {
    constexpr int kSteps = 16;
    for (int i = 0; i < kSteps; ++i) {
      const Real a = static_cast<Real>(i) / kSteps, b = static_cast<Real>(i + 1) / kSteps;
      area += arc.at(0, a) * arc.at(1, b) - arc.at(0, b) * arc.at(1, a);
    }
  }
  outward_ = area < 0 ? -1 : 1;
}

/// Appends the curve, split where its height turns.
void TracedLathe::add(const Cubic<2>& curve, std::array<Real, 2> from, std::array<Real, 2> to) {
  const auto& z = curve.c[1];
  const Real slope[] = {z[1], 2 * z[2], 3 * z[3]};
  const Nodes nodes = rootsWithEnds(slope, 0, 1);
  for (std::size_t i = 0; i + 1 < nodes.count; ++i) {
    const Real u0 = nodes.at[i], u1 = nodes.at[i + 1];
    std::array<Real, 2> next = to;
    if (i + 2 < nodes.count) next = {curve.at(0, u1), curve.at(1, u1)};
    Arc arc{curve, u0, u1, std::abs(from[0]), from[1], std::abs(next[0]), next[1], 0, 0, curves_};
    if (arc.z0 > arc.z1) {
      std::swap(arc.u0, arc.u1);
      std::swap(arc.r0, arc.r1);
      std::swap(arc.z0, arc.z1);
    }
    const auto& r = curve.c[0];  // between its Bezier ordinates
    const auto [least, most] = std::minmax(
        {from[0], next[0], r[0], r[0] + r[1] / 3, r[0] + (2 * r[1] + r[2]) / 3, r[0] + r[1] + r[2] + r[3]});
    arc.most = max(std::abs(least), std::abs(most));
    arc.least = least > 0 ? least * (1 - gammaError(32)) : most < 0 ? -most * (1 - gammaError(32)) : 0;
    arcs_.push_back(arc);
    bounds_.extend(Box3{{-arc.most, -arc.most, arc.z0}, {arc.most, arc.most, arc.z1}});
    error_ = maxComponent(max(abs(bounds_.low), abs(bounds_.high))) * gammaError(100);
    from = next;
  }
  ++curves_;
}

Real TracedLathe::Arc::at(Real z, Real guess) const {
  if (z <= z0) return u0;
  if (z >= z1) return u1;
  const auto height = [&](Real u) { return Jet{curve.at(1, u) - z, curve.slope(1, u)}; };
  return u0 < u1 ? rootBetween(height, u0, u1, true, guess) : rootBetween(height, u1, u0, false, guess);
}

void TracedLathe::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  if (bounds_.empty()) return;
  const Span span = spanIn(roomy(bounds_), ray);
  if (span.empty()) return;
  // Roughly from the near end, so that what lies behind a place already found need not be looked at.
  const bool forward = (ray.direction.z >= 0) == (arcs_.front().z0 <= arcs_.back().z0);
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const std::size_t number = forward ? i : arcs_.size() - 1 - i;
    meetArc(arcs_[number], static_cast<std::int64_t>(number), ray, span, range, visit);
  }
}

void TracedLathe::meetArc(const Arc& arc, std::int64_t number, const Ray& ray, const Span& span,
                          const Range& range, VisitCrossing visit) const {
  const Vec3 &o = ray.origin, &d = ray.direction;
  const auto square = [&](Real t) {
    const Real x = o.x + d.x * t, y = o.y + d.y * t;
    return x * x + y * y;
  };
  if (arc.flat()) {
    const Real t = (arc.z0 - o.z) / d.z;
    if (d.z != 0 && (square(t) < arc.r0 * arc.r0) != (square(t) < arc.r1 * arc.r1)) visit({t, number});
    return;
  }
  if (d.z == 0 && !(arc.z0 <= o.z && o.z < arc.z1)) return;

  // The stretch between the two heights. Its ends are the same numbers for the arcs that meet there.
  Real begin = span.from, end = span.to;
  bool bottomFirst = true, beginIsEnd = false, endIsEnd = false;  // orders at the ends of the arc
  if (d.z != 0) {
    bottomFirst = d.z > 0;
    const Real a = ((bottomFirst ? arc.z0 : arc.z1) - o.z) / d.z,
               b = ((bottomFirst ? arc.z1 : arc.z0) - o.z) / d.z;
    if (a >= begin) {
      begin = a;
      beginIsEnd = true;
    }
    if (b <= end) {
      end = b;
      endIsEnd = true;
    }
  }
  if (begin < range.from) {
    begin = range.from;
    beginIsEnd = false;
  }
  if (!(begin <= end && begin < range.to)) return;
  const Real dd = d.x * d.x + d.y * d.y;
  const Real closest = dd > 0 ? std::clamp(-(o.x * d.x + o.y * d.y) / dd, begin, end) : begin;
  if (!(square(closest) <= arc.most * arc.most * (1 + gammaError(32))))
    return;                                                             // it passes outside of all of it
  if (max(square(begin), square(end)) < arc.least * arc.least) return;  // or inside of all of it

  Real u = 0.5 * (arc.u0 + arc.u1);  // the latest place on the arc, where the next one is sought first
  const auto distance = [&](Real t) {
    u = arc.at(o.z + d.z * t, u);
    const Real r = arc.curve.at(0, u), x = o.x + d.x * t, y = o.y + d.y * t;
    const Real rise = arc.curve.slope(1, u);
    return Jet{x * x + y * y - r * r,
               2 * (x * d.x + y * d.y) - (rise != 0 ? 2 * r * arc.curve.slope(0, u) * d.z / rise : 0)};
  };
  // Places with one crossing between neighbours at most, and where a crossing is to be looked for first.
  std::array<Real, 10> nodes, guesses;
  std::size_t count = 0, guessCount = 0;
  if (begin < 0 && 0 < end) nodes[count++] = 0;
  const auto &r = arc.curve.c[0], &z = arc.curve.c[1];
  const bool straight = r[2] == 0 && r[3] == 0 && z[2] == 0 && z[3] == 0;
  if (d.z == 0) {
    nodes[count++] = closest;
  } else if (straight) {  // a cone: the distance turns once
    const Real slope = r[1] / z[1], at0 = r[0] + slope * (o.z - z[0]);
    const Real t = -(o.x * d.x + o.y * d.y - at0 * slope * d.z) / (dd - slope * slope * d.z * d.z);
    nodes[count++] = closest;
    if (begin < t && t < end) nodes[count++] = t;
  } else {  // along the arc the distance is a polynomial of degree six
    std::array<Real, 7> polynomial{};
    for (const auto& [start, slope] : {std::pair{o.x, d.x}, std::pair{o.y, d.y}}) {
      std::array<Real, 4> place{};
      for (std::size_t i = 0; i < 4; ++i) place[i] = slope * z[i] + (i == 0 ? start * d.z - slope * o.z : 0);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) polynomial[i + j] += place[i] * place[j];
    }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) polynomial[i + j] -= d.z * d.z * r[i] * r[j];
    const auto placeAt = [&](Real t, bool exact, bool bottom) {
      return !exact ? arc.at(o.z + d.z * t) : bottom ? arc.u0 : arc.u1;
    };
    const Real first = placeAt(begin, beginIsEnd, bottomFirst), past = placeAt(end, endIsEnd, !bottomFirst);
    // With room around it, so that the root that a ray starts next to, on the surface, is not lost at the
    // end.
    const Real bottom = min(arc.u0, arc.u1), top = max(arc.u0, arc.u1), room = (top - bottom) / 64;
    const Real low = max(bottom, min(first, past) - room), high = min(top, max(first, past) + room);
    u = first;
    if (signVariations(polynomial, low, high) == 0) return;
    const Nodes roots = rootsWithEnds(polynomial, low, high);
    const auto lineAt = [&](Real place) { return (arc.curve.at(1, place) - o.z) / d.z; };
    for (std::size_t i = 1; i + 1 < roots.count; ++i) {
      guesses[guessCount++] = lineAt(roots.at[i]);
      if (i > 1) nodes[count++] = lineAt(0.5 * (roots.at[i - 1] + roots.at[i]));
    }
  }
  std::sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(count));
  const auto insideAtEnd = [&](Real t, bool exact, bool bottom) {
    if (!exact) return distance(t).value < 0;
    const Real radius = bottom ? arc.r0 : arc.r1;
    return square(t) < radius * radius;
  };
  const auto root = [&](Real a, Real b, bool insideAtA) {
    Real guess = a;
    for (std::size_t i = 0; i < guessCount; ++i)
      if (a < guesses[i] && guesses[i] < b) guess = guesses[i];
    return rootNear(distance, a, b, insideAtA, guess);
  };
  const auto crossing = [&](Real t, bool) { visit({t, number}); };
  SignWalk walk{begin, insideAtEnd(begin, beginIsEnd, bottomFirst)};
  for (std::size_t i = 0; i < count && walk.at < range.to; ++i)
    if (walk.at < nodes[i] && nodes[i] < end) walk.to(nodes[i], distance(nodes[i]).value < 0, root, crossing);
  if (walk.at < range.to) walk.to(end, insideAtEnd(end, endIsEnd, !bottomFirst), root, crossing);
}

SurfacePoint TracedLathe::surface(const Ray& ray, const Crossing& crossing) const {
  const Arc& arc = arcs_[static_cast<std::size_t>(crossing.part)];
  Vec3 p = ray.at(crossing.t);
  const Real rho = std::sqrt(p.x * p.x + p.y * p.y);
  Vec3 around = rho > 0 ? Vec3{p.x / rho, p.y / rho, 0} : Vec3{1, 0, 0};
  Real u = 0, rise, grow;
  const Real low = min(arc.u0, arc.u1), high = max(arc.u0, arc.u1);
  if (arc.flat()) {
    rise = 0;
    grow = (arc.r1 - arc.r0) * (arc.u0 < arc.u1 ? 1 : -1);
    u = arc.r1 != arc.r0 ? std::clamp((rho - arc.r0) / (arc.r1 - arc.r0), 0.0, 1.0) : 0;
    p.z = arc.z0;
  } else {
    u = arc.at(p.z);
    const Real sign = arc.curve.at(0, u) < 0 ? -1 : 1;
    for (int step = 0; step < 4; ++step) {  // to the nearest place of the arc
      const Real dr = sign * arc.curve.at(0, u) - rho, dz = arc.curve.at(1, u) - p.z;
      const Real rs = sign * arc.curve.slope(0, u), zs = arc.curve.slope(1, u);
      const Real next = std::clamp(u - (dr * rs + dz * zs) / (rs * rs + zs * zs), low, high);
      if (!(std::abs(next - u) < 1e-3)) break;
      u = next;
    }
    const Real r = std::abs(arc.curve.at(0, u));
    p = around * r + Vec3{0, 0, arc.curve.at(1, u)};
    rise = arc.curve.slope(1, u);
    grow = sign * arc.curve.slope(0, u);
  }
  Vec3 n = normalize(around * rise - Vec3{0, 0, grow}) * outward_;
  if (!isFinite(n)) n = around;
  if (!solid_ && dot(n, ray.direction) > 0) n = -n;
  const Real along = arc.flat() ? arc.u0 + (arc.u1 - arc.u0) * u : u;
  const Real path = (arc.number + along) / curves_;
  return {p, {error_, error_, error_}, n, n, SurfaceUv::around(p, std::clamp(path, 0.0, 1.0))};
}

}  // namespace trace
