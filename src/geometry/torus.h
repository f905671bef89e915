// The torus: a circle of the minor radius carried around z along a circle of the major radius.
//
// The quartic along the ray (Glassner, section 2.4) only says where to look: between its extrema the distance
// to the tube changes sign once at most, and its sign and Newton's steps on it give the crossings. A minor
// radius above the major one gives the solid without its inner lemon.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/span.h"

namespace trace {

struct Torus {
  static constexpr std::string_view kKeyword = "torus";
  static constexpr std::string_view kHelp = "ring around z: a tube of one radius along a circle of another";

  Real majorRadius = 1, minorRadius = 0.25;

  static constexpr auto fields() {
    return std::tuple{Field{"major_radius", &Torus::majorRadius, "", 0, kNoLimit,
                            "from the axis to the middle of the tube"},
                      Field{"minor_radius", &Torus::minorRadius, "", 0, kNoLimit, "of the tube"}};
  }
  bool operator==(const Torus&) const = default;

  bool solid() const { return true; }
  Box3 bounds() const {
    const Real r = std::abs(minorRadius), out = std::abs(majorRadius) + r;
    return {{-out, -out, -r}, {out, out, r}};
  }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    const Span span = spanIn(roomy(bounds()), ray);
    if (span.empty()) return;
    const Real R = std::abs(majorRadius), r = std::abs(minorRadius);
    // From the point of the line nearest the centre, where the quartic is simplest and keeps its digits.
    const Vec3& d = ray.direction;
    const Real a = dot(d, d), middle = -dot(ray.origin, d) / a;
    const Vec3 o = ray.at(middle);
    const Real m = dot(o, o) + R * R - r * r, k = 4 * R * R;
    const Real quartic[] = {m * m - k * (o.x * o.x + o.y * o.y), -2 * k * (o.x * d.x + o.y * d.y),
                            2 * a * m - k * (d.x * d.x + d.y * d.y), 0, a * a};
    Nodes nodes = extremaWithEnds(quartic, span.from - middle, span.to - middle);
    for (std::size_t i = 0; i < nodes.count; ++i) nodes.at[i] += middle;
    const auto distance = [&](Real t) {
      const Vec3 p = ray.at(t);
      const Real rho = std::sqrt(p.x * p.x + p.y * p.y), out = rho - R;
      const Real rhoSlope = rho > 0 ? (p.x * d.x + p.y * d.y) / rho : 0;
      return Jet{out * out + p.z * p.z - r * r, 2 * (out * rhoSlope + p.z * d.z)};
    };
    signChanges(nodes, distance, [&](Real t, bool) { visit(Crossing{t, 0}); });
  }

  /// u goes around the axis, v around the tube, 0.5 outermost.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    const Real R = std::abs(majorRadius), r = std::abs(minorRadius);
    const Vec3 p = ray.at(crossing.t);
    const Real rho = std::sqrt(p.x * p.x + p.y * p.y);
    const Vec3 around = rho > 0 ? Vec3{p.x / rho, p.y / rho, 0} : Vec3{1, 0, 0};
    const Vec3 middle = around * R;
    const Vec3 n = normalize(p - middle);
    const Real error = (R + r) * gammaError(16);
    const Real u = 0.5 + std::atan2(p.y, p.x) / (2 * kPi), v = 0.5 + std::atan2(p.z, rho - R) / (2 * kPi);
    return {middle + n * r, {error, error, error}, n, n, {u, v}};
  }
};

}  // namespace trace
