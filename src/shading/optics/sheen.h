// A layer of fibres that stand up from the surface, as on velvet, felt and peaches: light at grazing angles
// (Estevez and Kulla, Production Friendly Microfacet Sheen BRDF, SIGGRAPH 2017 course; the denominator is
// Neubelt and Pettineo's, SIGGRAPH 2013 course, section 2). In the space of a Basis.
#pragma once

#include <cmath>

#include "math/elementary.h"
#include "math/vec.h"
#include "shading/scattering.h"

namespace trace {

/// The share of light that white sheen gives back to that cosine, tabulated.
Real sheenAlbedo(Real cosine, Real roughness);

struct Sheen {
  Real roughness = 0.5;

  static Sheen of(Real roughness) { return {max(0.05, min(1, roughness))}; }

  /// f cos(light) of white sheen.
  Real value(const Vec3& eye, const Vec3& light) const {
    const Vec3 half = halfway(eye, light);
    const Real sine = std::sqrt(max(0, 1 - half.z * half.z)), n = 1 / roughness;
    const Real spread = (2 + n) * math::pow(sine, n) / (2 * kPi);
    const Real sum = eye.z + light.z - eye.z * light.z;
    return sum > 0 ? spread / (4 * sum) * light.z : 0;
  }
  Real albedo(Real cosine) const { return sheenAlbedo(cosine, roughness); }
};

}  // namespace trace
