#include "geometry/shapes/surfaces/prism.h"

#include <algorithm>

#include "base/small_list.h"
#include "geometry/solve/interval_search.h"
#include "math/elementary.h"
#include "math/expression.h"

namespace trace {

std::shared_ptr<const TracedPrism> Prism::prepared() const {
  return std::make_shared<const TracedPrism>(*this);
}

namespace {

/// A bound of the curvature, from the control points of both derivatives; infinite where the curve may stop.
Real mostCurvature(const Cubic<2>& curve) {
  const auto &x = curve.c[0], &y = curve.c[1];
  using Vector = std::array<Real, 2>;
  const Vector first[] = {
      {x[1], y[1]}, {x[1] + x[2], y[1] + y[2]}, {x[1] + 2 * x[2] + 3 * x[3], y[1] + 2 * y[2] + 3 * y[3]}};
  const Vector second[] = {{2 * x[2], 2 * y[2]}, {2 * x[2] + 6 * x[3], 2 * y[2] + 6 * y[3]}};
  const Vector along{first[0][0] + first[1][0] + first[2][0], first[0][1] + first[1][1] + first[2][1]};
  const Real l = math::hypot(along[0], along[1]);
  Real slowest = kInfinity, bend = 0;
  for (const Vector& v : first) slowest = min(slowest, (v[0] * along[0] + v[1] * along[1]) / l);
  for (const Vector& v : second) bend = max(bend, math::hypot(v[0], v[1]));
  if (bend == 0) return 0;
  return slowest > 0 ? bend / (slowest * slowest) : kInfinity;
}

}  // namespace

TracedPrism::TracedPrism(const Prism& shape) : height_(std::abs(shape.height)) {
  slope_ = height_ > 0 ? (std::abs(shape.taper) - 1) / height_ : 0;
  addLoop(shape.spline, shape.outline);
  for (const Prism::Outline& hole : shape.holes) addLoop(shape.spline, hole);
  if (arcs_.empty() || !(height_ > 0)) {
    arcs_.clear();
    return;
  }
  const Real top = std::abs(shape.taper);
  bounds_ = base_;
  bounds_.extend(Box3{base_.low * top, base_.high * top});
  bounds_.low.z = 0;
  bounds_.high.z = height_;
  turn_ = std::isfinite(shape.twist) ? shape.twist * (kPi / 180) / height_ : 0;
  if (turn_ != 0) {
    const Vec3 far = max(abs(base_.low), abs(base_.high));
    radius_ = std::sqrt(far.x * far.x + far.y * far.y);
    for (Arc& arc : arcs_) arc.curvature = mostCurvature(arc.curve);
    const Real reach = radius_ * max(1, top);
    bounds_ = {{-reach, -reach, 0}, {reach, reach, height_}};
  }
  error_ = maxComponent(max(abs(bounds_.low), abs(bounds_.high))) * gammaError(200);

  // On which side each loop has its outside: it turns left or right, and lies in an even or odd number of
  // others.
  for (std::size_t first = 0; first < arcs_.size();) {
    std::size_t last = first;
    while (last + 1 < arcs_.size() && arcs_[last].to != arcs_[first].from) ++last;
    Real area = 0;
    for (std::size_t i = first; i <= last; ++i) {
      constexpr int kSteps = 16;
      for (int k = 0; k < kSteps; ++k) {
        const Real a = static_cast<Real>(k) / kSteps, b = static_cast<Real>(k + 1) / kSteps;
        const Cubic<2>& c = arcs_[i].curve;
        area += c.at(0, a) * c.at(1, b) - c.at(0, b) * c.at(1, a);
      }
    }
    // Just to the right of the middle of an arc: inside there, outside is to the left.
    const Cubic<2>& c = arcs_[first].curve;
    const Real dx = c.slope(0, 0.5), dy = c.slope(1, 0.5);
    const Real step = std::ldexp(std::sqrt(std::abs(area)), -20) / math::hypot(dx, dy);
    const bool insideRight = inside({c.at(0, 0.5) + dy * step, c.at(1, 0.5) - dx * step});
    for (std::size_t i = first; i <= last; ++i) arcs_[i].outward = insideRight ? -1 : 1;
    first = last + 1;
  }
}

void TracedPrism::addLoop(Spline spline, const Prism::Outline& points) {
  const Arcs<2> loop = loopOf(spline, points);
  for (std::size_t i = 0; i < loop.arcs.size(); ++i) {
    arcs_.push_back({loop.arcs[i], loop.ends[i], loop.ends[i + 1], 1});
    const auto &x = loop.arcs[i].c[0], &y = loop.arcs[i].c[1];
    const auto hull = [](const std::array<Real, 4>& c) {
      return std::minmax({c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, c[0] + c[1] + c[2] + c[3]});
    };
    const auto wide = hull(x), deep = hull(y);
    base_.extend(Box3{{wide.first, deep.first, 0}, {wide.second, deep.second, 0}});
    arcs_.back().low = {wide.first, deep.first};
    arcs_.back().high = {wide.second, deep.second};
  }
}

/// Calls visit(number, u) where an arc crosses the line normal . (x, y, 1) = 0.
template <class Visit>
void TracedPrism::meetPlane(const Vec3& normal, Visit&& visit) const {
  const auto side = [&](const std::array<Real, 2>& p) {
    return normal.x * p[0] + normal.y * p[1] + normal.z < 0;
  };
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const Arc& arc = arcs_[i];
    const auto &x = arc.curve.c[0], &y = arc.curve.c[1];
    std::array<Real, 4> cubic{};
    for (std::size_t k = 0; k < 4; ++k) cubic[k] = normal.x * x[k] + normal.y * y[k];
    cubic[0] += normal.z;
    const bool atStart = side(arc.from), atEnd = side(arc.to);
    if (cubic[2] == 0 && cubic[3] == 0) {
      if (atStart != atEnd) visit(i, std::clamp(-cubic[0] / cubic[1], 0.0, 1.0));
      continue;
    }
    const Nodes nodes = extremaWithEnds(cubic, 0, 1);
    const auto value = [&](Real u) { return evaluate(cubic, u); };
    const auto root = [&](Real a, Real b, bool negativeAtA) { return rootBetween(value, a, b, negativeAtA); };
    SignWalk walk{0, atStart};
    for (std::size_t n = 1; n < nodes.count; ++n) {
      const bool negative = n + 1 == nodes.count ? atEnd : value(nodes.at[n]).value < 0;
      walk.to(nodes.at[n], negative, root, [&](Real u, bool) { visit(i, u); });
    }
  }
}

bool TracedPrism::inside(const std::array<Real, 2>& p) const {
  bool odd = false;
  meetPlane({0, 1, -p[1]}, [&](std::size_t i, Real u) { odd ^= arcs_[i].curve.at(0, u) > p[0]; });
  return odd;
}

std::array<Real, 2> TracedPrism::unfolded(const Vec3& p) const {
  const auto [s, c] = math::sincos(turn_ * p.z);
  const Real scale = scaleAt(p.z);
  return {(c * p.x + s * p.y) / scale, (c * p.y - s * p.x) / scale};
}

TracedPrism::Nearest TracedPrism::nearest(const std::array<Real, 2>& p, Real care) const {
  Nearest found;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const Real atLeast = arcs_[i].distance(p) * (1 - gammaError(8));
    if (atLeast >= found.others) continue;
    if (atLeast > care) {
      found.others = atLeast;
      if (found.others < found.distance) std::swap(found.distance, found.others);
      continue;
    }
    const Cubic<2>& curve = arcs_[i].curve;
    Real least = kInfinity, where = 0;
    const auto consider = [&](Real u) {
      const Real dx = curve.at(0, u) - p[0], dy = curve.at(1, u) - p[1], square = dx * dx + dy * dy;
      if (square < least) {
        least = square;
        where = u;
      }
    };
    const auto &x = curve.c[0], &y = curve.c[1];
    consider(0);
    consider(1);
    if (x[2] == 0 && x[3] == 0 && y[2] == 0 && y[3] == 0) {
      const Real u = ((p[0] - x[0]) * x[1] + (p[1] - y[0]) * y[1]) / (x[1] * x[1] + y[1] * y[1]);
      if (0 < u && u < 1) consider(u);
    } else {
      std::array<Real, 7> square{};
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t l = 0; l < 4; ++l)
          square[k + l] += (x[k] - (k == 0 ? p[0] : 0)) * (x[l] - (l == 0 ? p[0] : 0)) +
                           (y[k] - (k == 0 ? p[1] : 0)) * (y[l] - (l == 0 ? p[1] : 0));
      const Nodes nodes = extremaWithEnds(square, 0, 1);
      for (std::size_t n = 1; n + 1 < nodes.count; ++n) consider(nodes.at[n]);
    }
    const Real distance = std::sqrt(least);
    if (distance < found.distance) {
      found = {distance, found.distance, where, i};
    } else {
      found.others = min(found.others, distance);
    }
  }
  return found;
}

/// The curve that a ray becomes in the outline's plane: where it is at t, and how it continues.
class TracedPrism::Twisted {
 public:
  Twisted(const TracedPrism& prism, const Ray& ray)
      : prism_(prism),
        ray_(ray),
        flat_(std::sqrt(ray.direction.x * ray.direction.x + ray.direction.y * ray.direction.y)),
        turn_(prism.turn_ * ray.direction.z),
        shrink_(prism.slope_ * ray.direction.z) {}

  /// The distance from the outline, negative inside.
  Jet at(Real t) const {
    const std::array<Real, 2> p = prism_.unfolded(ray_.at(t));
    const Nearest near = prism_.nearest(p);
    const bool in = prism_.inside(p);
    const Real distance = max(near.distance, std::numeric_limits<Real>::min());
    return {in ? -distance : distance, approach(near, p, t)};
  }

  Along<Interval> over(const Interval& t) const {
    const Real middle = 0.5 * (t.low + t.high), half = 0.5 * (t.high - t.low);
    const Interval everything = Interval::everything();
    // Its scale is least at one of the ends. What is far outside of the outline is of no concern.
    const Real scale = min(prism_.scaleAt(ray_.at(t.low).z), prism_.scaleAt(ray_.at(t.high).z));
    const Real reach = 1.5 * prism_.radius_, flat = flat_ / scale, shrink = std::abs(shrink_) / scale;
    const Real turn = std::abs(turn_), speed = (flat + (shrink + turn) * reach) * (1 + gammaError(64));
    const Real radius = half * speed + prism_.error_;
    if (!(scale > 0 && radius < 0.25 * prism_.radius_)) return {{-1, 1}, everything};
    const std::array<Real, 2> p = prism_.unfolded(ray_.at(middle));
    const Nearest near = prism_.nearest(p, 3 * radius);
    if (near.distance * (1 - gammaError(64)) > radius) {
      const Real sign = prism_.inside(p) ? -1 : 1;
      return {{sign, sign}, everything};
    }
    const Arc& arc = prism_.arcs_[near.arc];
    if (!(near.others > 3 * radius && 4 * radius * arc.curvature < 1)) return {{-1, 1}, everything};
    // Nearest is the inside of one arc. From the middle of the disk to anywhere in it, at most 2 radius from
    // the arc, the nearest place moves by so much, and its normal turns with it.
    const Real moved = radius / (1 - 2 * radius * arc.curvature);
    const Real bend = 2 * (flat + reach * shrink) * (shrink + turn) + reach * turn * turn;
    const Real unsure =
        (moved * arc.curvature * speed + half * bend) * (1 + gammaError(64)) + speed * gammaError(64);
    const Real slope = approach(near, p, middle);
    const bool hidden = max(near.distance, half * (std::abs(slope) + unsure)) < prism_.error_;
    if (hidden) return {{-1, 1}, slope};  // by rounding: the ends of the stretch decide
    return {{-1, 1}, {slope - unsure, slope + unsure}};
  }

 private:
  /// How fast it goes outward.
  Real approach(const Nearest& near, const std::array<Real, 2>& p, Real t) const {
    const Vec3 at = ray_.at(t);
    const Vec3& d = ray_.direction;
    const auto [s, c] = math::sincos(prism_.turn_ * at.z);
    const Real scale = prism_.scaleAt(at.z), shrink = shrink_ / scale;
    const Real vx = (c * d.x + s * d.y) / scale + turn_ * p[1] - shrink * p[0];
    const Real vy = (c * d.y - s * d.x) / scale - turn_ * p[0] - shrink * p[1];
    const Arc& arc = prism_.arcs_[near.arc];
    const Real nx = arc.curve.slope(1, near.u), ny = -arc.curve.slope(0, near.u);
    return arc.outward * (nx * vx + ny * vy) / std::sqrt(nx * nx + ny * ny);
  }

  const TracedPrism& prism_;
  const Ray& ray_;
  Real flat_, turn_, shrink_;
};

void TracedPrism::meetTwisted(const Ray& ray, const Crossing& in, const Crossing& out, const Range& range,
                              const VisitCrossing& visit) const {
  const Span box = spanIn(roomy(bounds_), ray);
  if (box.empty()) return;
  const Crossing first = box.from > in.t ? Crossing{box.from, kFirstSide} : in;
  const Crossing last = box.to < out.t ? Crossing{box.to, kFirstSide} : out;
  if (!(first.t < last.t)) return;
  const Twisted curve(*this, ray);
  const auto at = [&](Real t) { return curve.at(t); };
  const auto over = [&](const Interval& t) { return curve.over(t); };
  const auto inAt = [&](const Crossing& end) {
    return end.part < kFirstSide && inside(unfolded(ray.at(end.t)));
  };
  if (first.t >= range.from && inAt(first)) visit(first);
  intervalCrossings<44, false>({first.t, last.t}, range, over, at, [&](Real t, bool) {
    visit(Crossing{t, kFirstSide});
  });
  if (last.t > range.from && last.t <= range.to && inAt(last)) visit(last);
}

void TracedPrism::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  if (arcs_.empty()) return;
  const Vec3 &o = ray.origin, &d = ray.direction;
  Crossing in{-kInfinity, kBottom}, out{kInfinity, kTop};
  if (d.z != 0) {
    in.t = -o.z / d.z;
    out.t = (height_ - o.z) / d.z;
    if (d.z < 0) std::swap(in, out);
  } else if (o.z < 0 || o.z > height_) {
    return;
  }
  if (turn_ != 0) return meetTwisted(ray, in, out, range, visit);
  if (spanIn(roomy(bounds_), ray).empty()) return;

  const Vec3 a{o.x, o.y, scaleAt(o.z)}, b{d.x, d.y, slope_ * d.z};
  const Vec3 normal = cross(a, b);
  const auto within = [&](const Crossing& from, const Crossing& to) {
    const Crossing first = from.t > in.t ? from : in, last = to.t < out.t ? to : out;
    if (first.t <= last.t) {
      visit(first);
      visit(last);
    }
  };
  if (normal == Vec3{}) {  // towards the tip, or straight up: always the same place of the outline
    const Real middle = 0.5 * (in.t + out.t), scale = a.z + b.z * middle;
    if (scale > 0 && inside({(a.x + b.x * middle) / scale, (a.y + b.y * middle) / scale})) {
      visit(in);
      visit(out);
    }
    return;
  }
  SmallList<Crossing, 16> list;
  meetPlane(normal, [&](std::size_t i, Real u) {
    const Vec3 c{arcs_[i].curve.at(0, u), arcs_[i].curve.at(1, u), 1};
    const Vec3 ac = cross(a, c), bc = cross(b, c);
    const Real t = -dot(ac, bc) / dot(bc, bc);
    if (!(a.z + b.z * t > 0)) return;  // above the tip
    const auto step =
        std::clamp<std::int64_t>(std::llround(std::ldexp(u, kStepBits)), 0, (1 << kStepBits) - 1);
    list.add({t, kFirstSide + (static_cast<std::int64_t>(i) << kStepBits) + step});
  });
  // From the height of the tip, where the ray is infinitely far from the outline, outward.
  std::span<Crossing> sides = list.all();
  if (b.z < 0) {
    std::sort(sides.begin(), sides.end(), [](const Crossing& p, const Crossing& q) { return q.before(p); });
    for (std::size_t i = 0; i < sides.size(); i += 2)
      within(i + 1 < sides.size() ? sides[i + 1] : Crossing{-kInfinity, 0}, sides[i]);
  } else {
    std::sort(sides.begin(), sides.end(), [](const Crossing& p, const Crossing& q) { return p.before(q); });
    for (std::size_t i = 0; i < sides.size(); i += 2)
      within(sides[i], i + 1 < sides.size() ? sides[i + 1] : Crossing{kInfinity, 0});
  }
}

SurfacePoint TracedPrism::twistedSide(const Vec3& place) const {
  const Real z = std::clamp(place.z, 0.0, height_), s = scaleAt(z);
  const std::array<Real, 2> flat = unfolded({place.x, place.y, z});
  const Nearest near = nearest(flat);
  const Arc& arc = arcs_[near.arc];
  const Real u = near.u, x = arc.curve.at(0, u), y = arc.curve.at(1, u);
  const Real dx = arc.curve.slope(0, u) * arc.outward, dy = arc.curve.slope(1, u) * arc.outward;
  // The normal of the outline, turned up with it, and tilted as turning and scaling tilt it.
  const auto [q, c] = math::sincos(turn_ * z);
  const Real tilt = turn_ * s * (dy * y + dx * x) - slope_ * (dy * x - dx * y);
  Vec3 n = normalize(Vec3{c * dy + q * dx, q * dy - c * dx, tilt});
  if (!isFinite(n)) n = {0, 0, 1};
  const Real path = (static_cast<Real>(near.arc) + u) / static_cast<Real>(arcs_.size());
  return {{(c * x - q * y) * s, (q * x + c * y) * s, z}, {error_, error_, error_}, n, n, {path, z / height_}};
}

SurfacePoint TracedPrism::surface(const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t);
  if (turn_ != 0 && crossing.part >= kFirstSide) return twistedSide(p);
  const Vec3 error{error_, error_, error_};
  const Vec3 size = base_.size();
  if (crossing.part < kFirstSide) {
    const bool top = crossing.part == kTop;
    p.z = top ? height_ : 0;
    const Vec3 n{0, 0, top ? 1.0 : -1.0};
    const Real s = scaleAt(p.z);
    const std::array<Real, 2> flat = unfolded(p);
    const auto share = [&](int axis) {
      const Real place = flat[static_cast<std::size_t>(axis)];
      return s > 0 && size[axis] > 0 ? std::clamp((place - base_.low[axis]) / size[axis], 0.0, 1.0) : 0;
    };
    return {p, error, n, n, {share(0), share(1)}};
  }
  const std::int64_t part = crossing.part - kFirstSide;
  const auto number = static_cast<std::size_t>(part >> kStepBits);
  const Arc& arc = arcs_[number];
  p.z = std::clamp(p.z, 0.0, height_);
  const Real s = scaleAt(p.z);
  Real u = std::ldexp(static_cast<Real>(part & ((1 << kStepBits) - 1)), -kStepBits);
  for (int step = 0; step < 3 && s > 0; ++step) {  // to the nearest place of the arc
    const Real dx = arc.curve.slope(0, u), dy = arc.curve.slope(1, u);
    const Real next =
        u - ((arc.curve.at(0, u) - p.x / s) * dx + (arc.curve.at(1, u) - p.y / s) * dy) / (dx * dx + dy * dy);
    if (!(std::abs(next - u) < 1e-3)) break;
    u = std::clamp(next, 0.0, 1.0);
  }
  const Real x = arc.curve.at(0, u), y = arc.curve.at(1, u);
  const Real dx = arc.curve.slope(0, u), dy = arc.curve.slope(1, u);
  Vec3 n = normalize(Vec3{dy, -dx, slope_ * (dx * y - dy * x)}) * arc.outward;
  if (!isFinite(n)) n = {0, 0, 1};
  const Real path = (static_cast<Real>(number) + u) / static_cast<Real>(arcs_.size());
  return {{x * s, y * s, p.z}, error, n, n, {path, p.z / height_}};
}

}  // namespace trace
