// How much light a smooth surface between two media mirrors, by Fresnel's formulas (Born and Wolf, Principles
// of Optics, 1.5.3).
#pragma once

#include <cmath>

#include "math/vec.h"

namespace trace {

/// Shares mirrored of light that swings across the plane of incidence (s) and in it (p).
struct Reflectance {
  Real s, p;
  Real mean() const { return (s + p) / 2; }  ///< of unpolarised light
};

/// Between two dielectrics. `cosine` is that of the ray to the normal, in the medium before the surface; the
/// indices are those before and behind. 1 under total internal reflection.
inline Reflectance reflectanceDielectric(Real cosine, Real etaBefore, Real etaBehind) {
  const Real in = max(0, min(1, cosine));
  if (etaBefore == etaBehind) return {0, 0};
  const Real ratio = etaBefore / etaBehind, squared = 1 - ratio * ratio * (1 - in * in);
  if (squared < 0) return {1, 1};
  const Real out = std::sqrt(squared);
  const Real s = (etaBefore * in - etaBehind * out) / (etaBefore * in + etaBehind * out);
  const Real p = (etaBehind * in - etaBefore * out) / (etaBehind * in + etaBefore * out);
  return {s * s, p * p};
}

/// The share of unpolarised light that is mirrored.
inline Real fresnelDielectric(Real cosine, Real etaBefore, Real etaBehind) {
  return reflectanceDielectric(cosine, etaBefore, etaBehind).mean();
}

}  // namespace trace
