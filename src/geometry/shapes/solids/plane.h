// The plane z = 0 infinite. It bounds the half of space below it, so that water with a plane for its
// surface has its index of refraction underneath; the normal is +z from either side.
//
// Its bounds are infinite: the World tests it apart from the hierarchy. Where a ray runs into the half space
// and never leaves it, the other crossing of the pair lies at infinity.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/ray.h"
#include "math/box.h"

namespace trace {

struct Plane {
  static constexpr std::string_view kKeyword = "plane";
  static constexpr std::string_view kHelp = "infinite plane z = 0, solid below; its normal is +z";
  static constexpr auto fields() { return Fields{}; }
  bool operator==(const Plane&) const = default;

  bool solid() const { return true; }
  bool convex() const { return true; }
  Box3 bounds() const { return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, 0}}; }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    const Real height = ray.origin.z, d = ray.direction.z;
    const Real t = -height / d;
    if (d != 0 && isFinite(ray.at(t))) {
      visit(Crossing{t, 0});
      visit(Crossing{d < 0 ? kInfinity : -kInfinity, 0});
    } else if (height < 0) {  // parallel, as far as numbers go
      visit(Crossing{-kInfinity, 0});
      visit(Crossing{kInfinity, 0});
    }
  }

  /// uv repeats with every unit of length.
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    Vec3 p = ray.at(crossing.t);
    p.z = 0;
    const Real error = maxComponent(abs(p)) * gammaError(4);
    const Vec3 n{0, 0, 1};
    return {p, {error, error, error}, n, n, {p.x - std::floor(p.x), p.y - std::floor(p.y)}};
  }
};

}  // namespace trace
