// A matt base below a layer of microfacets of a dielectric: what plastic, varnish and glazed pots are. The
// base gets what the layer lets through on the way in and on the way out (Kelemen and Szirmay-Kalos, A
// Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001), so that with a white base all light
// comes back. What facets mirror is a LayerFresnel. In the space of a Basis.
#pragma once

#include "shading/optics/layer_fresnel.h"

namespace trace {

struct Coating {
  bool smooth = false;   ///< no lobe, one mirrored ray
  LayerFresnel fresnel;  ///< what one facet mirrors
  MicrofacetLobe lobe;
  Color meanAlbedo;

  Coating() = default;
  Coating(Distribution kind, Real roughness, Real anisotropy, const LayerFresnel& facet)
      : smooth(!(roughness > 0)), fresnel(facet) {
    const Color alongNormal = fresnel.alongNormal();
    if (!smooth) lobe = {Microfacets::of(kind, roughness, anisotropy), alongNormal};
    if (fresnel.isSchlick()) {
      meanAlbedo = smooth ? meanSchlick(alongNormal) : lobe.meanAlbedo(alongNormal);
      return;
    }
    nodes_ = fresnel.atNodes();
    const Color mean = weighed(meanFresnelShares());
    if (smooth) {
      meanAlbedo = mean;
    } else {
      lobe.multiple = lobe.multipleOf(mean);
      meanAlbedo = weighed(meanFacetShares(lobe.facets)) + lobe.multiple * (1 - lobe.meanWhite);
    }
  }

  /// The share of light that goes to `v`, or comes from there, and is mirrored.
  Color albedo(const Vec3& v) const {
    if (smooth) return fresnel(v.z);
    if (fresnel.isSchlick()) return lobe.albedo(v, fresnel.alongNormal());
    return weighed(facetShares(lobe.facets, v)) + lobe.multiple * (1 - lobe.white(v));
  }
  /// f cos(light) of the layer.
  Color mirrored(const Vec3& eye, const Vec3& light) const {
    return smooth ? Color(0) : lobe.value(eye, light, fresnel);
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

 private:
  Color weighed(const FacetShares& shares) const {
    Color sum;
    for (std::size_t k = 0; k < shares.size(); ++k) sum += nodes_[k] * shares[k];
    return clamp01(sum);
  }

  std::array<Color, kFresnelNodes> nodes_;  ///< nodes of `fresnel`, where it is not Schlick's
};

}  // namespace trace
