// The disk in the plane z = 0, or a ring of it: an open sheet, seen from both sides.
#pragma once

#include <algorithm>
#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"
#include "math/elementary.h"

namespace trace {

struct Disk {
  static constexpr std::string_view kKeyword = "disk";
  static constexpr std::string_view kHelp = "disk or ring around the origin at z = 0, two-sided";

  Real radius = 1, innerRadius = 0;

  static constexpr auto fields() {
    return Fields{Field{"radius", &Disk::radius, "", 0, kNoLimit, "of the outer edge"},
                  Field{"inner_radius", &Disk::innerRadius, "", 0, kNoLimit, "of the hole"}};
  }
  bool operator==(const Disk&) const = default;

  bool solid() const { return false; }
  bool convex() const { return true; }
  Box3 bounds() const {
    const Real r = std::abs(radius);
    return {{-r, -r, 0}, {r, r, 0}};
  }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    if (ray.direction.z == 0) return;
    const Real t = -ray.origin.z / ray.direction.z;
    const Vec3 p = ray.at(t);
    const Real square = p.x * p.x + p.y * p.y;
    if (square <= radius * radius && square >= innerRadius * innerRadius) visit(Crossing{t, 0});
  }

  /// u goes around, v outward from the centre.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    Vec3 p = ray.at(crossing.t);
    p.z = 0;
    const Real error = std::abs(radius) * gammaError(4);
    const Vec3 n{0, 0, ray.direction.z > 0 ? -1.0 : 1.0};
    const Real outward = std::min(1.0, math::hypot(p.x, p.y) / std::abs(radius));
    return {p, {error, error, error}, n, n, SurfaceUv::around(p, outward)};
  }
};

}  // namespace trace
