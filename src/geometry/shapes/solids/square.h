// The square x, y in [-0.5, 0.5], z = 0: an open sheet, seen from both sides.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"

namespace trace {

struct Square {
  static constexpr std::string_view kKeyword = "square";
  static constexpr std::string_view kHelp = "square from -0.5 to 0.5 in x and y, at z = 0, two-sided";
  static constexpr auto fields() { return Fields{}; }
  bool operator==(const Square&) const = default;

  bool solid() const { return false; }
  bool convex() const { return true; }
  Box3 bounds() const { return {{-0.5, -0.5, 0}, {0.5, 0.5, 0}}; }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    if (ray.direction.z == 0) return;
    const Real t = -ray.origin.z / ray.direction.z;
    const Vec3 p = ray.at(t);
    if (std::abs(p.x) <= 0.5 && std::abs(p.y) <= 0.5) visit(Crossing{t, 0});
  }

  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    Vec3 p = ray.at(crossing.t);
    p.z = 0;
    const Vec3 n{0, 0, ray.direction.z > 0 ? -1.0 : 1.0};
    return {p, Vec3{0.5, 0.5, 0.5} * gammaError(4), n, n, {p.x + 0.5, p.y + 0.5}};
  }
};

}  // namespace trace
