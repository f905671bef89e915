// The torus: a circle of the minor radius carried around z along a circle of the major radius.
//
// The quartic along the ray (Glassner, section 2.4) only says where to look: between its extrema the distance
// to the tube changes sign once at most, and its sign and Newton's steps on it give the crossings. A minor
// radius above the major one gives the solid without its inner lemon.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"

namespace trace {

struct Torus {
  static constexpr std::string_view kKeyword = "torus";
  static constexpr std::string_view kHelp = "ring around z: a tube of one radius along a circle of another";

  Real majorRadius = 1, minorRadius = 0.25;

  static constexpr auto fields() {
    return Fields{Field{"major_radius", &Torus::majorRadius, "", 0, kNoLimit,
                        "from the axis to the middle of the tube"},
                  Field{"minor_radius", &Torus::minorRadius, "", 0, kNoLimit, "radius of the tube"}};
  }
  bool operator==(const Torus&) const = default;

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
