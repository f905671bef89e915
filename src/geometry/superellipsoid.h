// The superellipsoid (Barr, Superquadrics and Angle-Preserving Transformations, 1981): between box, cylinder,
// sphere and octahedron,
//   ((|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n))^(n/2) = 1.
//
// For 0 < e, n <= 2 the left side is a norm, so that it is convex along a ray: Newton's steps from outside
// cannot miss it. The range ends there; beyond 2 the solid would be pinched to needles.
#pragma once

#include <algorithm>
#include <string_view>

#include "base/field.h"
#include "geometry/span.h"

namespace trace {

struct Superellipsoid {
  static constexpr std::string_view kKeyword = "superellipsoid";
  static constexpr std::string_view kHelp =
      "between box, cylinder, sphere and octahedron, from -1 to 1 in x, y and z";

  Real east = 0.5, north = 0.5;

  static constexpr auto fields() {
    return std::tuple{
        Field{"east", &Superellipsoid::east, "", 0.02, 2, "around z: towards 0 square, 1 round, 2 a diamond"},
        Field{"north", &Superellipsoid::north, "", 0.02, 2,
              "up and down: towards 0 flat, 1 round, 2 pointed"}};
  }
  bool operator==(const Superellipsoid&) const = default;

  bool solid() const { return true; }
  Box3 bounds() const { return {{-1, -1, -1}, {1, 1, 1}}; }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    const Span span = spanIn(roomy(bounds()), ray);
    if (span.empty()) return;
    convexCrossings(
        span,
        [&](Real t) {
          Vec3 slopes;
          const Real size = norm(ray.at(t), slopes);
          return Jet{size - 1, dot(slopes, ray.direction)};
        },
        [&](Real t, int end) {
          visit(Crossing{t, end});
        });
  }

  /// u goes around z, v up.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    Vec3 p = ray.at(crossing.t), slopes;
    const Real size = norm(p, slopes);
    if (size > 0) p = p / size;
    norm(p, slopes);
    const Vec3 n = normalize(slopes);
    const Real error = gammaError(80);
    const Real u = 0.5 + std::atan2(p.y, p.x) / (2 * kPi);
    const Real v = 0.5 + std::asin(std::clamp(p.z / length(p), -1.0, 1.0)) / kPi;
    return {p, {error, error, error}, n, n, {u, v}};
  }

 private:
  static constexpr Real exponent(Real squareness) { return 2 / std::clamp(squareness, 0.02, 2.0); }

  /// (a^p + b^p)^(1/p) for a, b >= 0, and its derivatives, without overflow.
  static Real norm2(Real a, Real b, Real p, Real& byA, Real& byB) {
    const Real most = max(a, b);
    if (most == 0) {
      byA = byB = p == 1 ? 1 : 0;
      return 0;
    }
    if (p == 1) {
      byA = byB = 1;
      return a + b;
    }
    if (p == 2) {
      const Real l = std::sqrt(a * a + b * b);
      byA = a / l, byB = b / l;
      return l;
    }
    const Real l = most * std::pow(1 + std::pow(min(a, b) / most, p), 1 / p);
    byA = std::pow(a / l, p - 1), byB = std::pow(b / l, p - 1);
    return l;
  }

  Real norm(const Vec3& p, Vec3& slopes) const {
    const Vec3 q = abs(p);
    Real byX, byY, byRho, byZ;
    const Real rho = norm2(q.x, q.y, exponent(east), byX, byY);
    const Real size = norm2(rho, q.z, exponent(north), byRho, byZ);
    slopes = {std::copysign(byRho * byX, p.x), std::copysign(byRho * byY, p.y), std::copysign(byZ, p.z)};
    return size;
  }
};

}  // namespace trace
