// A matt base below a layer of microfacets of a dielectric: what plastic, varnish and glazed pots are. The
// base gets what the layer lets through on the way in and on the way out (Kelemen and Szirmay-Kalos, A
// Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001), so that with a white base all light
// comes back. Fresnel's formula is Schlick's, for which albedos are tabulated; a thin film on the layer takes
// its place, where there is one. In the space of a Basis.
#pragma once

#include "shading/fresnel.h"
#include "shading/microfacet.h"
#include "shading/thin_film.h"

namespace trace {

struct Coating {
  bool smooth = false;  ///< no lobe, one mirrored ray
  Color alongNormal;    ///< what is mirrored of light along the normal
  MicrofacetLobe lobe;
  Color meanAlbedo;
  ThinFilm film;    ///< of thickness 0 there is none
  Real filmed = 1;  ///< share of the layer on which it lies

  Coating() = default;
  /// With a film on `share` of it.
  Coating(Distribution kind, Real roughness, Real anisotropy, const ThinFilm& onTop, Real share)
      : Coating(kind, roughness, anisotropy,
                lerp(share, Color(mirroredAlongNormal(onTop.behind)), onTop.mirrored(1))) {
    film = onTop;
    filmed = share;
    // Gauss's formula with three points, over the square of the cosine.
    constexpr Real kAway = 0.3872983346207417;  // half the root of 0.6
    meanAlbedo =
        (albedo({0, 0, std::sqrt(0.5 - kAway)}) + albedo({0, 0, std::sqrt(0.5 + kAway)})) * (5. / 18) +
        albedo({0, 0, std::sqrt(0.5)}) * (8. / 18);
  }
  Coating(Distribution kind, Real roughness, Real anisotropy, const Color& mirroredAlongNormal)
      : smooth(!(roughness > 0)), alongNormal(mirroredAlongNormal) {
    if (smooth) {
      meanAlbedo = alongNormal + (Color(1) + alongNormal * -1) / 21;
    } else {
      lobe = {Microfacets::of(kind, roughness, anisotropy), alongNormal};
      meanAlbedo = lobe.meanAlbedo(alongNormal);
    }
  }

  /// What one facet mirrors.
  Color fresnel(Real cosine) const {
    if (!(film.nanometres > 0)) return schlick(cosine, alongNormal);
    return lerp(filmed, schlick(cosine, Color(mirroredAlongNormal(film.behind))), film.mirrored(cosine));
  }
  /// The share of light that goes to `v`, or comes from there, and is mirrored; nearly, for rough films.
  Color albedo(const Vec3& v) const {
    if (film.nanometres > 0) {
      const Real once = smooth ? 1 : lobe.white(v);
      return fresnel(v.z) * once + lobe.multiple * (1 - once);
    }
    return smooth ? schlick(v.z, alongNormal) : lobe.albedo(v, alongNormal);
  }
  /// f cos(light) of the layer.
  Color mirrored(const Vec3& eye, const Vec3& light) const {
    return smooth ? Color(0) : lobe.value(eye, light, [&](Real cosine) { return fresnel(cosine); });
  }
  /// f cos(light) of a white base below it.
  Color base(const Vec3& eye, const Vec3& light) const {
    const auto less = [](Real a, Real b, Real mean) {
      return mean < 1 ? max(0, 1 - a) * max(0, 1 - b) / (kPi * (1 - mean)) : 0;
    };
    const Color a = albedo(eye), b = albedo(light);
    return Color{less(a.r, b.r, meanAlbedo.r), less(a.g, b.g, meanAlbedo.g), less(a.b, b.b, meanAlbedo.b)} *
           light.z;
  }
  /// Weight of the mirrored ray.
  Color mirrorWeight(Real cosine) const { return fresnel(cosine) * (smooth ? 1 : lobe.facets.sharpShare()); }

  /// How often `direction` follows the layer.
  Real share(const Vec3& eye, Real base) const {
    if (smooth) return 0;
    const Real layer = maxComponent(albedo(eye));
    return layer / (layer + base * (1 - layer));
  }
  Vec3 direction(const Vec3& eye, Real base, Real choose, Vec2 u) const {
    const Real s = share(eye, base);
    return choose < s ? lobe.direction(eye, choose / s, u) : cosineDirection(u);
  }
  Real density(const Vec3& eye, Real base, const Vec3& light) const {
    const Real s = share(eye, base);
    return (s > 0 ? s * lobe.density(eye, light) : 0) + (1 - s) * cosineDensity(light);
  }
};

}  // namespace trace
