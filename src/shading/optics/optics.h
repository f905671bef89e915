// Directions after a mirror or a change of medium.
#pragma once

#include <optional>

#include "math/vec.h"

namespace trace {

/// `direction` mirrored at a surface of unit `normal` (either side); keeps its length.
inline Vec3 mirrored(const Vec3& direction, const Vec3& normal) {
  return direction - normal * (2 * dot(direction, normal));
}

/// Snell's law for a unit `direction` that hits a surface whose unit `normal` points against it.
/// `ratio` = index before / index behind. Nothing under total internal reflection (Glassner, section 4.2).
inline std::optional<Vec3> refracted(const Vec3& direction, const Vec3& normal, Real ratio) {
  const Real cosIn = -dot(direction, normal);
  const Real cosOutSquared = 1 - ratio * ratio * (1 - cosIn * cosIn);
  if (cosOutSquared < 0) return {};
  return normalize(direction * ratio + normal * (ratio * cosIn - std::sqrt(cosOutSquared)));
}

/// The share of light that a smooth surface between two media mirrors: Schlick's approximation (Eurographics
/// 1994) of Fresnel's formula. `cosine` is that of the ray to the normal, in the medium before the surface. 1
/// under total internal reflection.
inline Real schlick(Real cosine, Real indexBefore, Real indexBehind) {
  cosine = max(0, min(1, cosine));
  if (indexBefore > indexBehind) {  // by the angle in the thinner medium, which reaches 90 degrees first
    const Real ratio = indexBefore / indexBehind, squared = 1 - ratio * ratio * (1 - cosine * cosine);
    if (squared < 0) return 1;
    cosine = std::sqrt(squared);
  }
  const Real r = (indexBefore - indexBehind) / (indexBefore + indexBehind), c = 1 - cosine;
  return r * r + (1 - r * r) * (c * c * c * c * c);
}

}  // namespace trace
