// Cones, truncated cones and cylinders around z that say where they begin and end: the course of the
// University of British Columbia has them as `Conic`. The frustum of cone.h, moved along its axis.
#pragma once

#include <algorithm>
#include <string_view>

#include "geometry/shapes/solids/cone.h"

namespace trace {

struct Conic {
  static constexpr std::string_view kKeyword = "conic";
  static constexpr std::string_view kHelp =
      "cone, truncated cone or cylinder along z, between z_min and z_max";
  static constexpr bool kAlongZ = true;

  Real bottomRadius = 1, topRadius = 0, zMin = 0, zMax = 1;
  bool capped = true;

  static constexpr auto fields() {
    return Fields{Field{"bottom_radius", &Conic::bottomRadius, "", 0, kNoLimit, "radius at z_min"},
                  Field{"top_radius", &Conic::topRadius, "", 0, kNoLimit, "radius at z_max"},
                  Field{"z_min", &Conic::zMin, "", -kNoLimit, kNoLimit, "where it begins"},
                  Field{"z_max", &Conic::zMax, "", -kNoLimit, kNoLimit, "where it ends"},
                  Field{"capped", &Conic::capped, "", 0, 1, "closed by flat ends; else an open sheet"}};
  }
  bool operator==(const Conic&) const = default;

  // Precondition of all that follows: zMin != zMax.
  Real low() const { return std::min(zMin, zMax); }
  Real high() const { return std::max(zMin, zMax); }
  Frustum frustum() const {
    const Real r0 = std::abs(bottomRadius), r1 = std::abs(topRadius), h = high() - low();
    return zMin < zMax ? Frustum{r0, r1, h, capped} : Frustum{r1, r0, h, capped};
  }
  bool solid() const { return capped; }
  bool convex() const { return capped; }
  Box3 bounds() const {
    const Real r = std::max(std::abs(bottomRadius), std::abs(topRadius));
    return {{-r, -r, low()}, {r, r, high()}};
  }
  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    frustum().crossings(moved(ray), visit);
  }
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    SurfacePoint s = frustum().surface(moved(ray), crossing);
    s.point.z = std::clamp(s.point.z + low(), low(), high());
    s.error += Vec3{0, 0, 1} * (gammaError(4) * std::max(std::abs(zMin), std::abs(zMax)));
    return s;
  }

 private:
  Ray moved(const Ray& ray) const { return {ray.origin - Vec3{0, 0, low()}, ray.direction}; }
};

}  // namespace trace
