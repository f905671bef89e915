// Fresnel's formulas: the share of unpolarised light that a smooth surface mirrors. Cosines are those of the
// light to the normal, in the medium before the surface.
#pragma once

#include <cmath>

#include "math/color.h"
#include "math/vec.h"

namespace trace {

/// Shares mirrored of light that swings across the plane of incidence (s) and in it (p).
struct Reflectance {
  Real s, p;
};

/// Between two media that do not absorb, of these indices of refraction (Born and Wolf, Principles of Optics,
/// section 1.5.2). 1 under total internal reflection, where equality with the critical angle counts; 0 where
/// the indices are equal.
inline Reflectance reflectanceDielectric(Real cosine, Real etaBefore, Real etaBehind) {
  if (etaBefore == etaBehind) return {0, 0};
  cosine = max(0, min(1, cosine));
  const Real ratio = etaBefore / etaBehind, squared = 1 - ratio * ratio * (1 - cosine * cosine);
  if (!(squared > 0)) return {1, 1};
  const Real behind = std::sqrt(squared);
  const Real s = (etaBefore * cosine - etaBehind * behind) / (etaBefore * cosine + etaBehind * behind);
  const Real p = (etaBehind * cosine - etaBefore * behind) / (etaBehind * cosine + etaBefore * behind);
  return {s * s, p * p};
}
/// The mean of both.
inline Real fresnelDielectric(Real cosine, Real etaBefore, Real etaBehind) {
  const Reflectance r = reflectanceDielectric(cosine, etaBefore, etaBehind);
  return (r.s + r.p) / 2;
}

/// From air or vacuum at a conductor of the complex index eta + i k, exactly (Born and Wolf, section 14.2; in
/// real numbers as in pbrt, 3rd ed., section 8.2.1).
inline Real fresnelConductor(Real cosine, Real eta, Real k) {
  const Real c = max(0, min(1, cosine)), cc = c * c, ss = 1 - cc, e = eta * eta, kk = k * k;
  const Real t = e - kk - ss;
  const Real root = std::sqrt(t * t + 4 * e * kk);  // a^2 + b^2
  const Real a = std::sqrt(max(0, (root + t) / 2));
  const Real s = (root + cc - 2 * a * c) / (root + cc + 2 * a * c);
  const Real p = s * (cc * root + ss * ss - 2 * a * c * ss) / (cc * root + ss * ss + 2 * a * c * ss);
  return (s + p) / 2;
}
inline Color fresnelConductor(Real cosine, const Color& eta, const Color& k) {
  return {fresnelConductor(cosine, eta.r, k.r), fresnelConductor(cosine, eta.g, k.g),
          fresnelConductor(cosine, eta.b, k.b)};
}

/// Schlick's approximation (Eurographics 1994), from what is mirrored of light along the normal.
inline Real schlickWeight(Real cosine) {
  const Real c = 1 - max(0, min(1, cosine)), cc = c * c;
  return cc * cc * c;
}
inline Color schlick(Real cosine, const Color& alongNormal) {
  return lerp(schlickWeight(cosine), alongNormal, Color(1));
}
/// Its mean over all directions, weighed by the cosine.
inline Color meanSchlick(const Color& alongNormal) {
  return alongNormal + (Color(1) + alongNormal * -1) / 21;
}
/// The reflectance of a smooth surface in air along its normal.
inline Real mirroredAlongNormal(Real index) {
  const Real r = (index - 1) / (index + 1);
  return r * r;
}

}  // namespace trace
