// The albedo of rough glass for light that hits one facet, tabulated, and what becomes of the
// rest, which hits several (Kulla and Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH
// 2017 course). Cosines are those to the normal that points out of the body: below 0 they are inside.
#pragma once

#include "shading/optics/microfacet.h"

namespace trace {

/// The share, by power, of light that comes from that side at that cosine above 0; eta = index behind / index
/// before. Isotropic, of the width of the facets' slopes. Indices beyond 4 to 1 count as these.
Real glassAlbedo(Distribution kind, Real cosine, Real width, Real eta);
/// The mean over all directions, weighed by the cosine.
Real meanGlassAlbedo(Distribution kind, Real width, Real eta);

/// The light that hits several facets of glass: it continues to both sides, whatever side it came from.
class GlassLoss {
 public:
  GlassLoss() = default;
  /// The loss of a body of that index in air. Precondition: the index is above 0, and not 1.
  GlassLoss(Distribution kind, Real width, Real index);

  bool none() const { return !(mean_[0] > 0 && mean_[1] > 0); }
  /// The share lost of light that comes from there.
  Real of(Real cosine) const {
    return 1 - glassAlbedo(kind_, std::abs(cosine), width_, cosine > 0 ? index_ : 1 / index_);
  }
  /// How much of that goes to the other side.
  Real passes(Real cosine) const { return passes_[cosine < 0]; }
  /// A direction above that side, chosen as densely as density() says: as much light leaves there.
  Vec3 direction(bool inside, Vec2 u) const;
  /// Per solid angle, to the side on which the light is. Precondition: not none().
  Real density(Real light) const { return of(light) * std::abs(light) / (kPi * mean_[light < 0]); }
  /// f |cos(light)|, for importance. Precondition: not none().
  Real value(Real eye, Real light) const {
    const bool across = (eye > 0) != (light > 0);
    const Real share = across ? passes(eye) : 1 - passes(eye);
    return share * of(eye) * density(light);
  }

 private:
  Distribution kind_ = Distribution::ggx;
  Real width_ = 0, index_ = 1;
  Real mean_[2] = {0, 0}, passes_[2] = {0, 0};  ///< outside and inside
};

}  // namespace trace
