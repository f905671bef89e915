// A matt base below a layer of microfacets of a dielectric: what plastic, varnish and glazed pots are. The
// base gets what the layer lets through on the way in and on the way out (Kelemen and Szirmay-Kalos, A
// Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001), so that with a white base all light
// comes back. Fresnel's formula is Schlick's, for which albedos are tabulated. In the space of a Basis.
#pragma once

#include "shading/fresnel.h"
#include "shading/microfacet.h"

namespace trace {

struct Coating {
  bool smooth = false;  ///< no lobe, one mirrored ray
  Color alongNormal;    ///< what is mirrored of light along the normal
  MicrofacetLobe lobe;
  Color meanAlbedo;

  Coating() = default;
  Coating(Distribution kind, Real roughness, Real anisotropy, const Color& mirroredAlongNormal)
      : smooth(!(roughness > 0)), alongNormal(mirroredAlongNormal) {
    if (smooth) {
      meanAlbedo = alongNormal + (Color(1) + alongNormal * -1) / 21;
    } else {
      lobe = {Microfacets::of(kind, roughness, anisotropy), alongNormal};
      meanAlbedo = lobe.meanAlbedo(alongNormal);
    }
  }

  /// The share of light that goes to `v`, or comes from there, and is mirrored.
  Color albedo(const Vec3& v) const {
    return smooth ? schlick(v.z, alongNormal) : lobe.albedo(v, alongNormal);
  }
  /// f cos(light) of the layer.
  Color mirrored(const Vec3& eye, const Vec3& light) const {
    return smooth ? Color(0)
                  : lobe.value(eye, light, [&](Real cosine) { return schlick(cosine, alongNormal); });
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
  Color mirrorWeight(Real cosine) const {
    return schlick(cosine, alongNormal) * (smooth ? 1 : lobe.facets.sharpShare());
  }

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
