// The supertoroid (Barr, Superquadrics and Angle-Preserving Transformations, 1981): a ring around z with a
// tube that may be square, round or a diamond, along a way that may be. With rho = (|x|^(2/e) +
// |y|^(2/e))^(e/2),
//   (|rho - R|^(2/n) + |z|^(2/n))^(n/2) = r.
//
// Found by interval arithmetic: of both norms and of their slopes the bounds are known exactly, because they
// are monotone in |x|, |y| and in |x| / |y|.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"

namespace trace {

struct Supertoroid {
  static constexpr std::string_view kKeyword = "supertoroid";
  static constexpr std::string_view kHelp = "ring around z, square, round or a diamond around and across";

  Real majorRadius = 1, minorRadius = 0.35, east = 0.5, north = 0.5;

  static constexpr auto fields() {
    return Fields{
        Field{"major_radius", &Supertoroid::majorRadius, "", 0, kNoLimit,
              "from the axis to the middle of the tube"},
        Field{"minor_radius", &Supertoroid::minorRadius, "", 0, kNoLimit, "radius of the tube"},
        Field{"east", &Supertoroid::east, "", 0.05, 2, "around z: towards 0 square, 1 round, 2 a diamond"},
        Field{"north", &Supertoroid::north, "", 0.05, 2, "the tube: towards 0 square, 1 round, 2 a diamond"}};
  }
  bool operator==(const Supertoroid&) const = default;

  bool solid() const { return true; }
  Box3 bounds() const {
    const Real r = std::abs(minorRadius), out = std::abs(majorRadius) + r;
    return {{-out, -out, -r}, {out, out, r}};
  }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  /// u goes around the axis, v around the tube, 0.5 outermost.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
};

}  // namespace trace
