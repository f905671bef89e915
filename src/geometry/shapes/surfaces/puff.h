// A ball of haze: densest in the middle, thinning out to nothing at its surface. Flames, sparks, smoke.
//
// What a ray passes through depends on how near the middle it goes: where the density is 1 - r^2 the optical
// depth is that through the middle times (1 - b^2)^(3/2), b being the ray's distance from it. The surface
// where the ray enters has, by the share 1 - exp(-depth) of light stopped, the material of the thickest haze,
// else that of the thinnest; where it leaves, the thinnest. With a thick material that only glows and a thin
// one that is clear this is the solution of the equation of transfer for haze that emits in proportion to
// what it absorbs.
#pragma once

#include <string_view>

#include "base/field.h"
#include "geometry/materials.h"
#include "geometry/shapes/solids/sphere.h"
#include "math/elementary.h"

namespace trace {

struct Puff {
  static constexpr std::string_view kKeyword = "puff";
  static constexpr std::string_view kHelp = "ball of haze, thick in the middle and clear at its edge";

  Real depth = 3;
  MaterialList materials;

  static constexpr auto fields() {
    return Fields{
        Field{"depth", &Puff::depth, "", 0, kNoLimit,
              "optical depth through the middle; at 1, 37 % of the light is transmitted"},
        Field{"materials", &Puff::materials, "", 0, 0,
              "materials from the thinnest haze to the thickest; by default from clear to its own"}};
  }
  bool operator==(const Puff&) const = default;

  bool solid() const { return true; }
  Box3 bounds() const { return Sphere{}.bounds(); }

  template <class Visit>
  void crossings(const Ray& ray, Visit&& visit) const {
    Sphere{}.crossings(ray, [&](const Crossing& c) { visit(Crossing{c.t, partAt(ray, c)}); });
  }
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    return Sphere{}.surface(ray, crossing);
  }

  std::int64_t partCount() const { return kLevels; }
  MaterialMix material(std::int64_t part, std::uint32_t own) const {
    const Real share = static_cast<Real>(part) / static_cast<Real>(kLevels - 1);
    return materials.empty() ? MaterialMix::between(MaterialMix::kClear, own, share) : materials.at(share);
  }
  void addMaterials(std::vector<std::uint32_t>& all) const {
    materials.addTo(all);
    if (materials.empty()) all.push_back(MaterialMix::kClear);
  }

 private:
  static constexpr std::int64_t kLevels = 1 << 16;

  /// How much is stopped behind the crossing: all of it where the ray enters, nothing where it leaves, but if
  /// it begins inside what lies before it.
  std::int64_t partAt(const Ray& ray, const Crossing& c) const {
    const Vec3& d = ray.direction;
    const Real speed = length(d), middle = dot(ray.origin, d) / speed;  // the way from the nearest place
    const Vec3 nearest = ray.origin - d * (middle / speed);
    const Real h2 = max(1 - dot(nearest, nearest), 0), h = std::sqrt(h2);
    const bool leaving = middle + c.t * speed > 0;
    const bool within = dot(ray.origin, ray.origin) < 1;
    if (leaving && !within) return 0;
    const auto before = [&](Real s) {
      return s * (h2 - s * s / 3);
    };  // coefficients of the density, from the nearest place
    const Real passed = before(h) - before(leaving ? std::clamp(middle, -h, h) : -h);
    const Real share = 1 - math::exp(-std::abs(depth) * 0.75 * passed);
    return std::llround(std::clamp(share, 0.0, 1.0) * static_cast<Real>(kLevels - 1));
  }
};

}  // namespace trace
