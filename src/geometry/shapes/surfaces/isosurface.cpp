#include "geometry/shapes/surfaces/isosurface.h"

#include <algorithm>

#include "geometry/solve/interval_search.h"

namespace trace {

std::shared_ptr<const TracedIsosurface> Isosurface::prepared() const {
  return std::make_shared<const TracedIsosurface>(*this);
}

TracedIsosurface::TracedIsosurface(const Isosurface& shape)
    : formula_(shape.formula),
      box_{min(shape.low, shape.high), max(shape.low, shape.high)},
      capped_(shape.capped) {}

void TracedIsosurface::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  const auto [in, out] = crossingsOf(box_, ray);
  if (!(in.t < out.t)) return;
  const auto at = [&](Real t) {
    const Along<Real> a = formula_.along(ray.origin, ray.direction, t);
    return Jet{a.value, a.slope};
  };
  const auto over = [&](const Interval& t) { return formula_.along(ray.origin, ray.direction, t); };
  if (capped_ && in.t > range.from && at(in.t).value < 0) visit(in);
  intervalCrossings({in.t, out.t}, range, over, at, [&](Real t, bool) { visit(Crossing{t, kSurface}); });
  if (capped_ && out.t > range.from && out.t <= range.to && at(out.t).value < 0) visit(out);
}

SurfacePoint TracedIsosurface::surface(const Ray& ray, const Crossing& crossing) const {
  Vec3 p = ray.at(crossing.t), n;
  const Vec3 size = box_.size();
  const Real reach = maxComponent(max(abs(box_.low), abs(box_.high))) * gammaError(8);
  Vec3 error{reach, reach, reach};
  if (crossing.part != kSurface) {
    const int axis = static_cast<int>(crossing.part / 2);
    const bool high = crossing.part % 2 != 0;
    p[axis] = high ? box_.high[axis] : box_.low[axis];
    n[axis] = high ? 1 : -1;
  } else {
    Vec3 g = formula_.gradientAt(p);
    for (int step = 0; step < 2; ++step) {  // back to the surface
      const Vec3 next = p - g * (formula_.at(p) / dot(g, g));
      if (!(length(next - p) < 1e-6 * length(size))) break;
      p = next;
      g = formula_.gradientAt(p);
    }
    const Real l = length(g);
    n = l > 0 && std::isfinite(l) ? g / l : normalize(-ray.direction);
    // Where the gradient vanishes nothing tells how near the surface is but its size.
    const Real off = min(l > 0 ? formula_.errorAt(p) / l : kInfinity, length(size) * 1e-7);
    error += Vec3{1, 1, 1} * (2 * off);
    for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], box_.low[i], box_.high[i]);
  }
  if (!capped_ && dot(n, ray.direction) > 0) n = -n;
  return {p, error, n, n, SurfaceUv::toward(normalize(p - box_.center()))};
}

}  // namespace trace
