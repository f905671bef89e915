// The unit sphere at the origin (Glassner, An Introduction to Ray Tracing, section 2.1).
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"
#include "math/roots.h"

namespace trace {

struct Sphere {
  static constexpr std::string_view kKeyword = "sphere";
  static constexpr std::string_view kHelp = "unit sphere at the origin";
  static constexpr auto fields() { return Fields{}; }
  bool operator==(const Sphere&) const = default;

  bool solid() const { return true; }
  bool convex() const { return true; }
  Box3 bounds() const { return {{-1, -1, -1}, {1, 1, 1}}; }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    const Vec3 &o = ray.origin, &d = ray.direction;
    const Real a = dot(d, d), b = dot(o, d);
    // The discriminant from the point of the line nearest the centre keeps its digits for far rays
    // (Haines et al., Ray Tracing Gems, chapter 7).
    const Vec3 nearest = o - d * (b / a);
    const Roots2 roots = solveQuadratic(a, b, dot(o, o) - 1, a * (1 - dot(nearest, nearest)));
    if (roots.count) {
      visit(Crossing{roots.t0, 0});
      visit(Crossing{roots.t1, 0});
    }
  }

  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    const Vec3 p = normalize(ray.at(crossing.t));
    return {p, abs(p) * gammaError(6), p, p, SurfaceUv::toward(p)};
  }
};

}  // namespace trace
