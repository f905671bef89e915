// The model of Cook and Torrance (A Reflectance Model for Computer Graphics, ACM TOG 1(1), 1982), as courses
// teach it: Lambert's term and a highlight F D G / (pi N.L N.V) of V-shaped grooves, Beckmann's distribution
// of slopes, and Fresnel's formula. Variant: D = exp(-(tan / m)^2) / (4 m^2 cos^4), with the 4 that keeps
// the energy right and that some prints lack.
// Reciprocal. Energy: the highlight alone gives back less than arrives; `diffuse` and `specular` are added.
//
// Use it to check the formula of a course. Not for new scenes: conductor and coated do the same with less
// loss.
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/microfacet.h"

namespace trace {

struct CookTorranceBsdf;

struct CookTorrance : SurfaceFields {
  static constexpr std::string_view kKeyword = "cook_torrance";
  static constexpr std::string_view kHelp = "Lambert's term and a highlight of grooves, by Cook and Torrance";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = CookTorranceBsdf;

  Color diffuse{0.4}, specular{0.5};
  Real roughness = 0.3;
  Real index = 1.5, absorption = 0;

  static constexpr auto fields() {
    return Fields{
        Field{"diffuse", &CookTorrance::diffuse, "", 0, 1, "diffuse reflectance"},
        Field{"specular", &CookTorrance::specular, "", 0, 1,
              "specular fraction: light reflected by the grooves"},
        Field{"roughness", &CookTorrance::roughness, "", 0, 1, "root mean square slope m of the grooves"},
        Field{"index", &CookTorrance::index, "", 0, kNoLimit, "real part of the index of refraction"},
        Field{"absorption", &CookTorrance::absorption, "", 0, kNoLimit,
              "imaginary part of the index: 0 is no metal"},
        SurfaceFields::fields()};
  }
  bool operator==(const CookTorrance&) const = default;

  Phong asPhong() const {
    const Real m = max(0.03, roughness);
    return phongLike(*this, diffuse, specular, 2 / (m * m));
  }
  CookTorranceBsdf at(const Rules& rules) const;
};

struct CookTorranceBsdf : LocalBsdf<CookTorranceBsdf, CookTorrance> {
  Microfacets facets;
  Real share = 0;  ///< how often `direction` follows the highlight

  CookTorranceBsdf() = default;
  explicit CookTorranceBsdf(const CookTorrance& model) : LocalBsdf(model) {
    index = model.index;
    const Real m = max(0.003, model.roughness);
    facets = {Distribution::beckmann, m, m};
    const Real even = maxComponent(model.diffuse), lobe = maxComponent(model.specular);
    if (lobe > 0) share = lobe / (lobe + even);
  }

  bool scatters() const { return !isBlack(said.diffuse) || !isBlack(said.specular); }
  Scatter value(const Vec3& eye, const Vec3& light) const {
    const Vec3 half = halfway(eye, light);
    const Real facing = dot(eye, half);
    if (!(facing > 0) || !(half.z > 0)) return {said.diffuse * (light.z / kPi), {}};
    // G / N.V, which stays finite where N.V does not.
    const Real g = min(1 / max(eye.z, 1e-300), 2 * half.z / facing * min(1, light.z / max(eye.z, 1e-300)));
    const Real F = fresnelConductor(facing, said.index, said.absorption);
    return {said.diffuse * (light.z / kPi), said.specular * (F * facets.spread(half) * g / 4)};
  }
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const {
    return choose < share ? mirroredAt(facets.chosen(eye, u), eye) : cosineDirection(u);
  }
  Real directionDensity(const Vec3& eye, const Vec3& light) const {
    return share * facets.density(eye, light) + (1 - share) * cosineDensity(light);
  }
};

inline CookTorranceBsdf CookTorrance::at(const Rules&) const { return CookTorranceBsdf(*this); }

}  // namespace trace
