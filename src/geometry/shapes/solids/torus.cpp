#include "geometry/shapes/solids/torus.h"

#include <algorithm>

#include "geometry/solve/span.h"
#include "math/elementary.h"

namespace trace {

void Torus::crossings(const Ray& ray, const Range& range, VisitCrossing visit) const {
  Span span = spanIn(roomy(bounds()), ray);
  span.from = max(span.from, range.from);
  if (span.empty()) return;
  const Real R = std::abs(majorRadius), r = std::abs(minorRadius);
  const Vec3 &d = ray.direction, &start = ray.origin;
  // A line that stays in the hole, or far from the axis.
  const auto axisSquare = [&](Real t) {
    const Real x = start.x + d.x * t, y = start.y + d.y * t;
    return x * x + y * y;
  };
  const Real flat = d.x * d.x + d.y * d.y, turn = -(start.x * d.x + start.y * d.y) / flat;
  constexpr Real kRoom = 1 + 0x1p-40;
  const Real hole = R - r, rim = (R + r) * kRoom;
  if (axisSquare(flat > 0 ? std::clamp(turn, span.from, span.to) : span.from) > rim * rim) return;
  if (hole > 0 && max(axisSquare(span.from), axisSquare(span.to)) * kRoom < hole * hole) return;

  // From the point of the line nearest the centre, where the quartic is simplest and keeps its digits.
  const Real a = dot(d, d), middle = -dot(start, d) / a;
  const Vec3 o = ray.at(middle);
  const Real m = dot(o, o) + R * R - r * r, k = 4 * R * R;
  const Real quartic[] = {m * m - k * (o.x * o.x + o.y * o.y), -2 * k * (o.x * d.x + o.y * d.y),
                          2 * a * m - k * flat, 0, a * a};
  const Nodes nodes = extremaWithEnds(quartic, span.from - middle, span.to - middle);
  const auto distance = [&](Real t) {
    const Vec3 p = ray.at(t);
    const Real rho = std::sqrt(p.x * p.x + p.y * p.y), out = rho - R;
    const Real rhoSlope = rho > 0 ? (p.x * d.x + p.y * d.y) / rho : 0;
    return Jet{out * out + p.z * p.z - r * r, 2 * (out * rhoSlope + p.z * d.z)};
  };
  SignWalk walk{span.from, distance(span.from).value < 0};
  for (std::size_t i = 1; i < nodes.count && walk.at < range.to; ++i) {
    const Real node = i + 1 == nodes.count ? span.to : nodes.at[i] + middle;
    if (walk.at < node) walk.to(node, distance, [&](Real t, bool) { visit(Crossing{t, 0}); });
  }
}

SurfacePoint Torus::surface(const Ray& ray, const Crossing& crossing) const {
  const Real R = std::abs(majorRadius), r = std::abs(minorRadius);
  const Vec3 p = ray.at(crossing.t);
  const Real rho = std::sqrt(p.x * p.x + p.y * p.y);
  const Vec3 around = rho > 0 ? Vec3{p.x / rho, p.y / rho, 0} : Vec3{1, 0, 0};
  const Vec3 middle = around * R;
  const Vec3 n = normalize(p - middle);
  const Real error = (R + r) * gammaError(16);
  const Real v = 0.5 + math::atan2(p.z, rho - R) / (2 * kPi);
  return {middle + n * r, {error, error, error}, n, n, SurfaceUv::around(p, v)};
}

}  // namespace trace
