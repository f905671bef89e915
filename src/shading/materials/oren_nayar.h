// A rough surface of Lambertian facets (Oren and Nayar, Generalization of Lambert's Reflectance Model,
// SIGGRAPH 1994): flat like the full moon, as clay and plaster are. Variant: the paper's qualitative model
// (equation 30), without light between the facets.
// Reciprocal. Energy: gives back at most `diffuse`, less the rougher it is.
//
// Use it for clay, plaster, stone, the moon. Not for cloth, whose fibres stand up (velvet).
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/scattering.h"

namespace trace {

struct OrenNayarBsdf;

struct OrenNayar : SurfaceFields {
  static constexpr std::string_view kKeyword = "oren_nayar";
  static constexpr std::string_view kHelp = "rough, dusty surface as of clay or the moon, by Oren and Nayar";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = OrenNayarBsdf;

  Color diffuse{0.8};
  Real roughness = 0.5;

  static constexpr auto fields() {
    return Fields{Field{"diffuse", &OrenNayar::diffuse, "", 0, 1, "reflectance of the facets"},
                  Field{"roughness", &OrenNayar::roughness, "radians", 0, 1.5,
                        "standard deviation of the facets' slope angle; 0 is Lambert's surface"},
                  SurfaceFields::fields()};
  }
  bool operator==(const OrenNayar&) const = default;

  Phong asPhong() const { return phongLike(*this, diffuse); }
  OrenNayarBsdf at(const Rules& rules) const;
};

struct OrenNayarBsdf : LocalBsdf<OrenNayarBsdf, OrenNayar> {
  Real a = 1, b = 0;  ///< a and b of equation 30

  OrenNayarBsdf() = default;
  explicit OrenNayarBsdf(const OrenNayar& model) : LocalBsdf(model) {
    const Real s = model.roughness * model.roughness;
    a = 1 - 0.5 * s / (s + 0.33);
    b = 0.45 * s / (s + 0.09);
  }

  bool scatters() const { return !isBlack(said.diffuse); }
  Scatter value(const Vec3& eye, const Vec3& light) const {
    // cos(phi) sin(alpha) tan(beta): sin sin / cos of the smaller angle, which has the larger cosine.
    const Real towards = eye.x * light.x + eye.y * light.y;
    const Real more = towards > 0 ? towards / max(eye.z, light.z) : 0;
    return {said.diffuse * ((a + b * more) * light.z / kPi), {}};
  }
};

inline OrenNayarBsdf OrenNayar::at(const Rules&) const { return OrenNayarBsdf(*this); }

}  // namespace trace
