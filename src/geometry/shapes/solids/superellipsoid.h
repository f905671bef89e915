// The superellipsoid (Barr, Superquadrics and Angle-Preserving Transformations, 1981): between box, cylinder,
// sphere and octahedron,
//   ((|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n))^(n/2) = 1.
//
// For 0 < e, n <= 2 the left side is a norm, so that it is convex along a ray: Newton's steps from outside
// cannot miss it. The range ends there; beyond 2 the solid would be pinched to needles.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"

namespace trace {

struct Superellipsoid {
  static constexpr std::string_view kKeyword = "superellipsoid";
  static constexpr std::string_view kHelp =
      "between box, cylinder, sphere and octahedron, from -1 to 1 in x, y and z";

  Real east = 0.5, north = 0.5;

  static constexpr auto fields() {
    return Fields{
        Field{"east", &Superellipsoid::east, "", 0.02, 2, "around z: towards 0 square, 1 round, 2 a diamond"},
        Field{"north", &Superellipsoid::north, "", 0.02, 2,
              "up and down: towards 0 flat, 1 round, 2 pointed"}};
  }
  bool operator==(const Superellipsoid&) const = default;

  bool solid() const { return true; }
  bool convex() const { return true; }
  Box3 bounds() const { return {{-1, -1, -1}, {1, 1, 1}}; }

  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  /// u goes around z, v up.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
};

}  // namespace trace
