// The cheap model of Schlick (A Customizable Reflectance Model for Everyday Rendering, EGWR 1993; An
// Inexpensive BRDF Model, Eurographics 1994): one roughness from a mirror to Lambert's surface, one isotropy.
// Variant: a single layer; light that the facets hide is scattered evenly, (1 - G G') / pi.
// Reciprocal. Energy: gives back what arrives or less up to 60 degrees, but more at grazing angles, where the
// two terms overlap: if it is white up to 1.27 of it at 80 degrees, 1.52 at 85 and 2.5 at 89.
//
// Use it for a fast preview with grain. Not for white things at grazing angles: they glow.
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/fresnel.h"
#include "shading/scattering.h"

namespace trace {

struct SchlickBsdf;

struct SchlickModel : SurfaceFields {
  static constexpr std::string_view kKeyword = "schlick";
  static constexpr std::string_view kHelp = "anything between mirror and chalk in two numbers, by Schlick";
  static constexpr bool kReciprocal = true, kKeepsEnergy = false;
  using Bsdf = SchlickBsdf;

  Color color{0.7};
  Real roughness = 0.2, isotropy = 1, angle = 0;

  static constexpr auto fields() {
    return Fields{
        Field{"color", &SchlickModel::color, "", 0, 1, "reflectance along the half-way vector"},
        Field{"roughness", &SchlickModel::roughness, "", 0, 1, "from 0, a mirror, to 1, Lambert's surface"},
        Field{"isotropy", &SchlickModel::isotropy, "", 0, 1, "from 0, all grain, to 1, no grain"},
        Field{"angle", &SchlickModel::angle, "degrees", -360, 360,
              "angle of the grain to the direction in which u grows"},
        SurfaceFields::fields()};
  }
  bool operator==(const SchlickModel&) const = default;

  Phong asPhong() const {
    const Real r = max(0.002, roughness);
    return phongLike(*this, color * roughness, color * (1 - roughness), 2 / r);
  }
  SchlickBsdf at(const Rules& rules) const;
};

struct SchlickBsdf : LocalBsdf<SchlickBsdf, SchlickModel> {
  Real r = 1, p = 1;

  SchlickBsdf() = default;
  explicit SchlickBsdf(const SchlickModel& model) : LocalBsdf(model) {
    r = max(0.002, min(1, model.roughness));
    p = max(0.002, min(1, model.isotropy));
  }

  bool scatters() const { return !isBlack(said.color); }
  /// How steeply facets may be seen.
  Real seen(Real cosine) const { return cosine / (r - r * cosine + cosine); }
  /// Facets by their lean and by their turn from the grain, whose mean over the circle is 1.
  Real lean(Real cosine) const {
    const Real t = 1 + (r - 1) * cosine * cosine;
    return r / (t * t);
  }
  Real turn(const Vec3& half) const {
    const Real flat = half.x * half.x + half.y * half.y;
    const Real ww = flat > 0 ? half.x * half.x / flat : 1;  // facets lean across the grain
    return std::sqrt(p / (p * p - p * p * ww + ww));
  }
  Scatter value(const Vec3& eye, const Vec3& light) const {
    const Vec3 half = halfway(eye, light);
    const Real gg = seen(eye.z) * seen(light.z);
    const Color F = schlick(dot(eye, half), said.color);
    // G G' / (4 pi N.V N.L), times N.L.
    const Real lobe = 1 / ((r - r * eye.z + eye.z) * (r - r * light.z + light.z)) * light.z / (4 * kPi);
    return {F * ((1 - gg) / kPi * light.z), F * (lobe * lean(half.z) * turn(half))};
  }
  /// Half-way vectors by their lean: cos^2 = u / (r - r u + u), as the paper has it for isotropy.
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const {
    if (choose < r) return cosineDirection(u);
    const Real cosine = std::sqrt(u.x / (r - r * u.x + u.x));
    return mirroredAt(sphericalDirection(cosine, 2 * kPi * u.y), eye);
  }
  Real directionDensity(const Vec3& eye, const Vec3& light) const {
    const Vec3 half = halfway(eye, light);
    const Real facing = dot(eye, half), cosine = std::abs(half.z);
    const Real lobe = facing > 0 ? lean(cosine) * cosine / (kPi * 4 * facing) : 0;
    return r * cosineDensity(light) + (1 - r) * lobe;
  }
};

inline SchlickBsdf SchlickModel::at(const Rules&) const { return SchlickBsdf(*this); }

}  // namespace trace
