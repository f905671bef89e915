// The reflectance of one facet of a clear layer in air: Schlick's approximation or Fresnel's formula for the
// layer's index of refraction, and what a thin film on it changes. A film that vanishes changes nothing.
#pragma once

#include <array>

#include "shading/optics/fresnel.h"
#include "shading/optics/microfacet.h"
#include "shading/optics/thin_film.h"

namespace trace {

class LayerFresnel {
 public:
  LayerFresnel() = default;  ///< nothing
  /// `alongNormal`: the reflectance along the normal, which the index gives unless it is tinted. `exact`: by
  /// Fresnel's formula, which a tint stretches to begin at `alongNormal`.
  LayerFresnel(const Color& alongNormal, Real index, bool exact)
      : alongNormal_(alongNormal), index_(index), exact_(exact) {}
  /// With a film of that index and thickness, in nanometres, on `share` of the layer.
  LayerFresnel withFilm(Real index, Real nanometres, Real share) const {
    LayerFresnel other = *this;
    other.film_ = {index, index_, nanometres};
    other.filmed_ = nanometres > 0 ? max(0, min(1, share)) : 0;
    return other;
  }

  /// Schlick's approximation, whose albedos are tabulated by the reflectance along the normal alone.
  bool isSchlick() const { return !exact_ && !(filmed_ > 0); }
  Color alongNormal() const { return alongNormal_; }

  /// The reflectance of unpolarised light at that cosine to the normal.
  Color operator()(Real cosine) const {
    const Color bare = exact_ ? exact(cosine) : schlick(cosine, alongNormal_);
    if (!(filmed_ > 0)) return bare;
    // By the difference that the film makes, whatever formula the bare layer follows.
    const ThinFilm none{film_.index, film_.behind, 0};
    return clamp01(bare + (film_.mirrored(cosine) + none.mirrored(cosine) * -1) * filmed_);
  }

  /// The values at the nodes of FacetShares.
  std::array<Color, kFresnelNodes> atNodes() const {
    std::array<Color, kFresnelNodes> values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = (*this)(fresnelNode(k));
    return values;
  }

 private:
  Color exact(Real cosine) const {
    const Real own = mirroredAlongNormal(index_), mirrored = fresnelDielectric(cosine, 1, index_);
    if (alongNormal_ == Color(own)) return Color(mirrored);
    return clamp01(lerp(own < 1 ? (mirrored - own) / (1 - own) : 1, alongNormal_, Color(1)));
  }

  Color alongNormal_;
  Real index_ = 1;
  bool exact_ = false;
  ThinFilm film_;
  Real filmed_ = 0;  ///< share of the layer
};

}  // namespace trace
