// A point of an opaque surface that scatters by the cosine and does nothing else, as most points of most
// scenes: what Interaction, Onward and the Bsdf say of it, with the same bits and without asking them.
#pragma once

#include <optional>

#include "math/perpendicular.h"
#include "render/world/world.h"

namespace trace {

class EvenPoint {
 public:
  /// The Bsdf of the hit, if the surface there is of that kind; else null. Not with options that concern
  /// opaque surfaces: Settings::varnish and Settings::smoothTerminator.
  static const PhongBsdf* bsdfOf(const World& world, const Hit& hit) {
    const Bsdf* bsdf = world.plainBsdf(hit);
    const auto* phong = bsdf ? bsdf->as<PhongBsdf>() : nullptr;
    return phong && phong->isEven() && !phong->transmits() && !phong->mirrors() ? phong : nullptr;
  }

  /// Where the ray, which runs in `inside`, ends at `hit`. All must live longer.
  EvenPoint(const Ray& ray, const Hit& hit, const PhongBsdf& bsdf, const Interfaces& inside)
      : hit_(hit),
        inside_(inside),
        diffuse_(bsdf.diffuse),
        normal_(hit.twoSided && hit.isBehind(ray.direction) ? -hit.surface.shading : hit.surface.shading),
        facing_(-dot(ray.direction, hit.surface.normal)),
        seen_(bsdf.scatters() && dot(normal_, -ray.direction) > 0) {}

  const Vec3& point() const { return hit_.surface.point; }
  Ray leave(const Vec3& direction) const { return hit_.leave(direction); }
  const Interfaces& side(const Vec3&) const { return inside_; }

  /// The scattering of light from that direction to where the ray comes from, times the cosine.
  Color scattered(const Vec3& toLight) const {
    const Real cosine = dot(normal_, toLight);
    return seen_ && cosine > 0 && !isAstray(toLight) ? diffuse_ * cosine / kPi : Color(0);
  }
  /// The density, per solid angle, with which sample() gives a direction that scattered() has light from.
  Real density(const Vec3& toLight) const { return max(0, dot(normal_, toLight)) / kPi; }

  struct Sample {
    Vec3 direction;
    Real density;
  };
  /// A direction, by two numbers from 0 up to 1. Its light counts by the diffuse reflectance.
  std::optional<Sample> sample(const Vec2& u) const {
    if (!seen_) return {};
    const Vec3 local = cosineDirection(u);
    if (!(local.z > 0)) return {};
    const Vec3 x = perpendicularTo(normal_), y = cross(normal_, x);
    const Vec3 direction = x * local.x + y * local.y + normal_ * local.z;
    if (!(dot(direction, normal_) < 0) && isAstray(direction)) return {};
    return Sample{direction, local.z / kPi};
  }

 private:
  /// It leads below the surface, on the side that light is seen on by the normal for shading.
  bool isAstray(const Vec3& direction) const { return dot(direction, hit_.surface.normal) * facing_ < 0; }

  const Hit& hit_;
  const Interfaces& inside_;
  const Color& diffuse_;
  Vec3 normal_;
  Real facing_;
  bool seen_;
};

}  // namespace trace
