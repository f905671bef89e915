// Lambert's law: light is scattered evenly, whatever it comes from (Photometria, 1760).
// Reciprocal. Energy: gives back `diffuse` of what arrives, from every direction.
//
// Use it for walls and paper, and where a guarantee is wanted: a test scene. Not for dusty things seen
// against the light (oren_nayar).
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/scattering.h"

namespace trace {

struct LambertBsdf;

struct Lambert : SurfaceFields {
  static constexpr std::string_view kKeyword = "lambert";
  static constexpr std::string_view kHelp = "perfectly diffuse surface, by Lambert";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = LambertBsdf;

  Color diffuse{0.8};

  static constexpr auto fields() {
    return Fields{Field{"diffuse", &Lambert::diffuse, "", 0, 1, "diffuse reflectance"},
                  SurfaceFields::fields()};
  }
  bool operator==(const Lambert&) const = default;

  Phong asPhong() const { return phongLike(*this, diffuse); }
  LambertBsdf at(const Rules& rules) const;
};

struct LambertBsdf : LocalBsdf<LambertBsdf, Lambert> {
  using LocalBsdf::LocalBsdf;

  bool scatters() const { return !isBlack(said.diffuse); }
  Scatter value(const Vec3&, const Vec3& light) const { return {said.diffuse * (light.z / kPi), {}}; }
};

inline LambertBsdf Lambert::at(const Rules&) const { return LambertBsdf(*this); }

}  // namespace trace
