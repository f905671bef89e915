// Metal whose surface is rough on a small scale: microfacets of GGX or Beckmann with Smith's masking, mirrors
// by Fresnel's formula for conductors (exact, from measured indices) or Schlick's, and light that is mirrored
// several times (shading/optics/microfacet.h); with a thin film on it anodised titanium and tempered steel
// (shading/optics/thin_film.h). Variant: height-correlated masking; grain after Burley 2012.
// Reciprocal. Energy: gives back what the metal's colour says, all of it if that is white.
//
// Under Whitted's equation the mirrored ray stands for the mirrors that lean less than 5 degrees.
//
// Use it for bare metal. Not for painted metal (coated), nor with invented indices: the library has measured
// ones.
#pragma once

#include <string_view>

#include "shading/materials/phong.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/metals.h"
#include "shading/optics/microfacet.h"
#include "shading/optics/thin_film.h"

namespace trace {

struct ConductorBsdf;

struct Conductor : SurfaceFields {
  static constexpr std::string_view kKeyword = "conductor";
  static constexpr std::string_view kHelp = "metal, polished, brushed or rough, by microfacets";
  static constexpr bool kReciprocal = true, kKeepsEnergy = true;
  using Bsdf = ConductorBsdf;

  Metal metal = Metal::none;
  Color color{0.9};
  Real roughness = 0.3, anisotropy = 0, angle = 0;
  Distribution distribution = Distribution::ggx;
  Real film = 0, filmIndex = 2.4;

  static constexpr auto fields() {
    return Fields{
        Field{"metal", &Conductor::metal, "", 0, kNoLimit, "a metal, by its measured indices of refraction"},
        Field{"color", &Conductor::color, "", 0, 1,
              "reflectance along the normal; a factor for a named metal"},
        Field{"roughness", &Conductor::roughness, "", 0, 1,
              "from 0, a mirror, to 1; the slope width of the facets is its square"},
        Field{"anisotropy", &Conductor::anisotropy, "", 0, 1, "how much the surface is brushed"},
        Field{"angle", &Conductor::angle, "degrees", -360, 360,
              "angle of the grain to the direction in which u grows"},
        Field{"distribution", &Conductor::distribution, "", 0, kNoLimit,
              "distribution of the facets' slopes"},
        Field{"film", &Conductor::film, "nanometres", 0, 5000,
              "thickness of a clear interference film, such as an oxide; 0 is none"},
        Field{"film_index", &Conductor::filmIndex, "", 1, kNoLimit, "index of refraction of the film"},
        SurfaceFields::fields()};
  }
  bool operator==(const Conductor&) const = default;

  /// The reflectance of one facet.
  Color mirrored(Real cosine) const {
    const ThinFilm oxide{filmIndex, 1, film};
    if (metal == Metal::none) {
      const Color bare = schlick(cosine, color);
      return film > 0 ? clamp01(bare + oxide.changeOn(color, cosine)) : bare;
    }
    const ComplexIndex index = indexOf(metal);
    return color *
           (film > 0 ? oxide.mirroredOn(index, cosine) : fresnelConductor(cosine, index.eta, index.k));
  }

  Phong asPhong() const {
    const Color own = mirrored(1);
    const Real width = max(0.03, roughness * roughness);
    Phong phong = phongLike(*this, own * (0.5 * roughness), own * 0.8, 2 / (width * width));
    phong.reflective = own * Microfacets::of(distribution, roughness).sharpShare();
    return phong;
  }
  ConductorBsdf at(const Rules& rules) const;
};

struct ConductorBsdf : LocalBsdf<ConductorBsdf, Conductor> {
  MicrofacetLobe lobe;
  Real sharp = 1;  ///< share of the mirrored ray

  ConductorBsdf() = default;
  explicit ConductorBsdf(const Conductor& model) : LocalBsdf(model) {
    const Color own = model.mirrored(1);
    if (scatters()) {
      lobe = {Microfacets::of(model.distribution, model.roughness, model.anisotropy), own};
      sharp = lobe.facets.sharpShare();
    }
    reflective = own * sharp;
  }

  bool scatters() const { return said.roughness > 0; }
  bool mirrorIsExact() const { return !scatters(); }
  Color mirrorWeight(Real cosine) const { return said.mirrored(cosine) * sharp; }

  Scatter value(const Vec3& eye, const Vec3& light) const {
    return {{}, lobe.value(eye, light, [&](Real cosine) { return said.mirrored(cosine); })};
  }
  Vec3 direction(const Vec3& eye, Real choose, Vec2 u) const { return lobe.direction(eye, choose, u); }
  Real directionDensity(const Vec3& eye, const Vec3& light) const { return lobe.density(eye, light); }
};

inline ConductorBsdf Conductor::at(const Rules&) const { return ConductorBsdf(*this); }

}  // namespace trace
