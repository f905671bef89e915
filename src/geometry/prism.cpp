#include "geometry/prism.h"

#include <algorithm>

#include "base/small_list.h"

namespace trace {

std::shared_ptr<const TracedPrism> Prism::prepared() const {
  return std::make_shared<const TracedPrism>(*this);
}

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
  bounds_.low.z = 0, bounds_.high.z = height_;
  error_ = maxComponent(max(abs(bounds_.low), abs(bounds_.high))) * gammaError(100);

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
    const Real step = std::ldexp(std::sqrt(std::abs(area)), -20) / std::hypot(dx, dy);
    const bool insideRight = inside({c.at(0, 0.5) + dy * step, c.at(1, 0.5) - dx * step});
    for (std::size_t i = first; i <= last; ++i) arcs_[i].outward = insideRight ? -1 : 1;
    first = last + 1;
  }
}

void TracedPrism::addLoop(Spline spline, Prism::Outline points) {
  if (points.empty()) return;
  const bool wrapsThree = spline == Spline::bspline || spline == Spline::catmull;
  const Prism::Outline begin(points.begin(),
                             points.begin() + std::min<std::ptrdiff_t>(std::ssize(points), 3));
  if (wrapsThree)
    points.insert(points.end(), begin.begin(), begin.end());
  else if (points.back() != points.front() && (spline == Spline::linear || points.size() % 3 == 0))
    points.push_back(points.front());
  const Arcs<2> loop = arcsOf<2>(spline, points);
  for (std::size_t i = 0; i < loop.arcs.size(); ++i) {
    arcs_.push_back({loop.arcs[i], loop.ends[i], loop.ends[i + 1], 1});
    const auto &x = loop.arcs[i].c[0], &y = loop.arcs[i].c[1];
    const auto hull = [](const std::array<Real, 4>& c) {
      return std::minmax({c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, c[0] + c[1] + c[2] + c[3]});
    };
    const auto wide = hull(x), deep = hull(y);
    base_.extend(Box3{{wide.first, deep.first, 0}, {wide.second, deep.second, 0}});
  }
  if (loop.ends.empty() || loop.ends.back() == loop.ends.front()) return;
  const auto &a = loop.ends.back(), &b = loop.ends.front();  // what is left is closed by a line
  arcs_.push_back({{{{{a[0], b[0] - a[0], 0, 0}, {a[1], b[1] - a[1], 0, 0}}}}, a, b, 1});
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
    bool negative = side(arc.from);
    const bool atEnd = side(arc.to);
    if (cubic[2] == 0 && cubic[3] == 0) {
      if (negative != atEnd) visit(i, std::clamp(-cubic[0] / cubic[1], 0.0, 1.0));
      continue;
    }
    const Nodes nodes = extremaWithEnds(cubic, 0, 1);
    const auto value = [&](Real u) { return evaluate(cubic, u); };
    for (std::size_t n = 1; n < nodes.count; ++n) {
      const bool after = n + 1 == nodes.count ? atEnd : value(nodes.at[n]).value < 0;
      if (after != negative) visit(i, rootBetween(value, nodes.at[n - 1], nodes.at[n], negative));
      negative = after;
    }
  }
}

bool TracedPrism::inside(const std::array<Real, 2>& p) const {
  bool odd = false;
  meetPlane({0, 1, -p[1]}, [&](std::size_t i, Real u) { odd ^= arcs_[i].curve.at(0, u) > p[0]; });
  return odd;
}

void TracedPrism::crossings(const Ray& ray, VisitCrossing visit) const {
  if (arcs_.empty()) return;
  const Vec3 &o = ray.origin, &d = ray.direction;
  Crossing in{-kInfinity, kBottom}, out{kInfinity, kTop};
  if (d.z != 0) {
    in.t = -o.z / d.z, out.t = (height_ - o.z) / d.z;
    if (d.z < 0) std::swap(in, out);
  } else if (o.z < 0 || o.z > height_) {
    return;
  }
  if (spanIn(roomy(bounds_), ray).empty()) return;

  const Vec3 a{o.x, o.y, scaleAt(o.z)}, b{d.x, d.y, slope_ * d.z};
  const Vec3 normal = cross(a, b);
  const auto within = [&](const Crossing& from, const Crossing& to) {
    const Crossing first = from.t > in.t ? from : in, last = to.t < out.t ? to : out;
    if (first.t <= last.t) visit(first), visit(last);
  };
  if (normal == Vec3{}) {  // towards the tip, or straight up: always the same place of the outline
    const Real middle = 0.5 * (in.t + out.t), scale = a.z + b.z * middle;
    if (scale > 0 && inside({(a.x + b.x * middle) / scale, (a.y + b.y * middle) / scale}))
      visit(in), visit(out);
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
    std::sort(sides.begin(), sides.end(), [](const Crossing& p, const Crossing& q) { return p.t > q.t; });
    for (std::size_t i = 0; i < sides.size(); i += 2)
      within(i + 1 < sides.size() ? sides[i + 1] : Crossing{-kInfinity, 0}, sides[i]);
  } else {
    std::sort(sides.begin(), sides.end(), [](const Crossing& p, const Crossing& q) { return p.t < q.t; });
    for (std::size_t i = 0; i < sides.size(); i += 2)
      within(sides[i], i + 1 < sides.size() ? sides[i + 1] : Crossing{kInfinity, 0});
  }
}

SurfacePoint TracedPrism::surface(const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t);
  const Vec3 error{error_, error_, error_};
  const Vec3 size = base_.size();
  if (crossing.part < kFirstSide) {
    const bool top = crossing.part == kTop;
    p.z = top ? height_ : 0;
    const Vec3 n{0, 0, top ? 1.0 : -1.0};
    const Real s = scaleAt(p.z);
    const auto share = [&](int axis) {
      return s > 0 && size[axis] > 0 ? std::clamp((p[axis] / s - base_.low[axis]) / size[axis], 0.0, 1.0) : 0;
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
