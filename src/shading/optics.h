// Directions after a mirror or a change of medium.
#pragma once

#include <optional>

#include "math/vec.h"

namespace trace {

/// `direction` mirrored at a surface of unit `normal` (either side); keeps its length.
inline Vec3 mirrored(const Vec3& direction, const Vec3& normal) {
  return direction - normal * (2 * dot(direction, normal));
}

/// Snell's law for a unit `direction` that meets a surface whose unit `normal` points against it.
/// `ratio` = index before / index behind. Nothing under total internal reflection (Glassner, section 4.2).
inline std::optional<Vec3> refracted(const Vec3& direction, const Vec3& normal, Real ratio) {
  const Real cosIn = -dot(direction, normal);
  const Real cosOutSquared = 1 - ratio * ratio * (1 - cosIn * cosIn);
  if (cosOutSquared < 0) return {};
  return normalize(direction * ratio + normal * (ratio * cosIn - std::sqrt(cosOutSquared)));
}

}  // namespace trace
