#include "geometry/shapes/surfaces/metaballs.h"

#include <algorithm>

#include "base/small_list.h"
#include "math/near_root.h"

namespace trace {

std::shared_ptr<const TracedMetaballs> Metaballs::prepared() const {
  return std::make_shared<const TracedMetaballs>(*this);
}

TracedMetaballs::TracedMetaballs(const Metaballs& shape)
    : threshold_(max(shape.threshold, std::numeric_limits<Real>::min())) {
  const auto add = [&](const Vec3& from, const Vec3& to, Real radius, Real strength) {
    if (!(radius != 0 && strength != 0)) return;
    const Vec3 axis = to - from;
    components_.push_back({from, axis, std::abs(radius), strength, dot(axis, axis)});
    curvature_ += 8 * std::abs(strength) / (radius * radius);
  };
  for (const auto& [x, y, z, radius, strength] : shape.balls) add({x, y, z}, {x, y, z}, radius, strength);
  for (const auto& [x, y, z, x2, y2, z2, radius, strength] : shape.capsules)
    add({x, y, z}, {x2, y2, z2}, radius, strength);

  std::vector<Box3> boxes;
  for (const Component& c : components_) {
    const Vec3 r = Vec3{1, 1, 1} * c.radius;
    const Vec3 to = c.from + c.axis;
    boxes.push_back({min(c.from, to) - r, max(c.from, to) + r});
    if (c.strength > 0) bounds_.extend(boxes.back());
  }
  tree_ = LineTree(std::move(boxes));
}

Vec3 TracedMetaballs::Component::nearest(const Vec3& p) const {
  if (axisSquare == 0) return from;
  return from + axis * std::clamp(dot(p - from, axis) / axisSquare, 0.0, 1.0);
}

/// A part of a ray along which one point of a component, or its line, is the nearest, and nearer than its
/// radius. Nothing in it sets itself to zero, so that room for many costs nothing.
struct TracedMetaballs::Piece {
  enum Nearest { first, line, last };
  const Component* component;
  Nearest nearest;
  Real speed;  ///< the square of that at which the offset changes, in radii
  Real begin, end;

  /// The way from the nearest point, which is linear in t.
  Vec3 offset(const Vec3& p) const {
    const Vec3 v = p - component->from;
    if (nearest == first) return v;
    if (nearest == last) return v - component->axis;
    return v - component->axis * (dot(v, component->axis) / component->axisSquare);
  }
};

void TracedMetaballs::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  const Span span = spanIn(roomy(bounds_), ray);
  if (span.empty()) return;
  const Real first = max(span.from, range.from), origin = 0.5 * (span.from + span.to);
  const Vec3 o = ray.at(origin), d = ray.direction;

  SmallList<Piece, 24> pieces;
  SmallList<Real, 64> ends;
  const auto addPiece = [&](const Component& c, Piece::Nearest nearest, Real begin, Real end) {
    Piece piece{&c, nearest, 0, begin, end};
    const Vec3 v = piece.offset(o);
    const Vec3 w = nearest == Piece::line ? d - c.axis * (dot(d, c.axis) / c.axisSquare) : d;
    const Real r2 = c.radius * c.radius, ww = dot(w, w), vw = dot(v, w), vv = dot(v, v);
    if (ww > 0) {
      const Vec3 near = v - w * (vw / ww);
      const Roots2 roots = solveQuadratic(ww, vw, vv - r2, ww * (r2 - dot(near, near)));
      if (!roots.count) return;
      piece.begin = max(begin, origin + roots.t0);
      piece.end = min(end, origin + roots.t1);
    } else if (vv >= r2) {
      return;
    }
    piece.speed = ww / r2;
    piece.begin = max(piece.begin, first);
    piece.end = min(piece.end, span.to);
    if (!(piece.begin < piece.end)) return;
    pieces.add(piece);
    ends.add(piece.begin);
    ends.add(piece.end);
  };
  tree_.query(ray, [&](std::uint32_t number) {
    const Component& c = components_[number];
    if (c.axisSquare == 0) return addPiece(c, Piece::first, -kInfinity, kInfinity);
    const Real along = dot(d, c.axis), start = -dot(o - c.from, c.axis);
    if (along == 0) {
      const auto nearest = start > 0 ? Piece::first : -start > c.axisSquare ? Piece::last : Piece::line;
      return addPiece(c, nearest, -kInfinity, kInfinity);
    }
    const Real t0 = origin + start / along, t1 = origin + (start + c.axisSquare) / along;
    addPiece(c, Piece::line, min(t0, t1), max(t0, t1));
    addPiece(c, along > 0 ? Piece::first : Piece::last, -kInfinity, min(t0, t1));
    addPiece(c, along > 0 ? Piece::last : Piece::first, max(t0, t1), kInfinity);
  });
  if (pieces.size() == 0) return;

  if (first < 0 && 0 < span.to) ends.add(0);
  std::span<Real> at = ends.all();
  std::sort(at.begin(), at.end());
  const std::size_t count = static_cast<std::size_t>(std::unique(at.begin(), at.end()) - at.begin());

  bool inside = false, known = false;
  std::size_t i = 0;
  for (; i + 1 < count && at[i] < range.to; ++i) {
    const Real begin = at[i], end = at[i + 1], middle = 0.5 * (begin + end);
    SmallList<const Piece*, 24> active;
    Real most = 0;
    for (const Piece& piece : pieces.all()) {
      if (!(piece.begin <= middle && middle <= piece.end)) continue;
      active.add(&piece);
      most += max(piece.component->strength, 0);
    }
    if (most <= threshold_) {  // the sum cannot reach it
      if (inside) visit(Crossing{begin, 0});
      inside = false;
      known = true;
      continue;
    }
    Real quartic[5] = {threshold_, 0, 0, 0, 0};  // the sum around the middle
    const Vec3 there = ray.at(middle);
    for (const Piece* piece : active.all()) {
      const Vec3 v = piece->offset(there);
      const Real k = piece->component->strength, r2 = piece->component->radius * piece->component->radius;
      const Real a = piece->speed, b = dot(v, d) / r2, c = 1 - dot(v, v) / r2;
      quartic[0] -= k * c * c;
      quartic[1] += 4 * k * c * b;
      quartic[2] += k * (2 * c * a - 4 * b * b);
      quartic[3] -= 4 * k * a * b;
      quartic[4] -= k * a * a;
    }
    const auto sum = [&](Real t) {
      Jet total{threshold_, 0};
      const Vec3 p = ray.at(t);
      for (const Piece* piece : active.all()) {
        const Vec3 v = piece->offset(p);
        const Real r2 = piece->component->radius * piece->component->radius;
        const Real share = 1 - dot(v, v) / r2, k = piece->component->strength;
        if (!(share > 0)) continue;
        total.value -= k * share * share;
        total.slope += 4 * k * share * dot(v, d) / r2;
      }
      return total;
    };
    const auto isInside = [&](Real t) { return sum(t).value < 0; };
    if (!known) {
      inside = begin > span.from && isInside(begin);
      known = true;
    }
    // The polynomial tells where to look; the signs are those of the sum itself.
    const Nodes roots = rootsWithEnds(quartic, begin - middle, end - middle);
    SignWalk walk{begin, inside};
    for (std::size_t n = 1; n == 1 || n + 1 < roots.count; ++n) {
      const bool toEnd = n + 2 >= roots.count;
      const Real node =
          toEnd ? end : std::clamp(middle + 0.5 * (roots.at[n] + roots.at[n + 1]), walk.at, end);
      const auto root = [&](Real a, Real b, bool insideAtA) {
        return rootNear(sum, a, b, insideAtA, middle + roots.at[n]);
      };
      walk.to(node, isInside(node), root, [&](Real t, bool) { visit(Crossing{t, 0}); });
    }
    inside = walk.negative;
  }
  if (inside && i + 1 == count) visit(Crossing{at[i], 0});
}

SurfacePoint TracedMetaballs::surface(const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t), gradient;
  Real error = 0;
  const auto sum = [&](const Vec3& at) {
    Real value = threshold_;
    gradient = {};
    error = threshold_ * gammaError(4);
    const Ray line{at, ray.direction};
    tree_.query(line, [&](std::uint32_t number) {
      const Component& c = components_[number];
      const Vec3 v = at - c.nearest(at);
      const Real r2 = c.radius * c.radius, share = 1 - dot(v, v) / r2;
      if (!(share > 0)) return;
      value -= c.strength * share * share;
      gradient += v * (4 * c.strength * share / r2);
      const Real reach = length(abs(at) + abs(c.from) + abs(c.axis));
      error += std::abs(c.strength) * (4 * share * length(v) * reach / r2 * gammaError(16) + gammaError(16));
    });
    return value;
  };
  Real value = sum(p);
  for (int step = 0; step < 2; ++step) {  // back to the surface
    const Real square = dot(gradient, gradient);
    const Vec3 next = p - gradient * (value / square);
    if (!(length(next - p) < 1e-6 * length(bounds_.size()))) break;
    p = next;
    value = sum(p);
  }
  const Real l = length(gradient);
  const Vec3 n = l > 0 ? gradient / l : Vec3{0, 0, 1};
  // Where the surface pinches the gradient vanishes, and the error is a square root.
  const Real off = min(l > 0 ? error / l : kInfinity, std::sqrt(error / curvature_));
  const Real e = 2 * off + maxComponent(abs(p)) * gammaError(8);
  return {p, {e, e, e}, n, n, SurfaceUv::toward(normalize(p - bounds_.center()))};
}

}  // namespace trace
