// Ray differentials: how a ray changes from one sample of the picture to the next on the right (X) and to the
// next above (Y). They tell how much of a surface a sample stands for (Igehy, Tracing Ray Differentials,
// SIGGRAPH 1999; numbers of equations are his).
#pragma once

#include "math/vec.h"

namespace trace {

struct Differentials {
  Vec3 originX, originY;        ///< derivatives of the origin; on arrival, of the hit point
  Vec3 directionX, directionY;  ///< derivatives of its unit direction
};

/// The differentials of a ray of unit `direction` where it hits a plane of unit `normal` at distance t (10,
/// 12).
inline Differentials arrived(const Differentials& d, const Vec3& direction, Real t, const Vec3& normal) {
  const Real against = dot(direction, normal);
  const auto place = [&](const Vec3& origin, const Vec3& turn) {
    const Vec3 moved = origin + turn * t;
    return moved - direction * (dot(moved, normal) / against);
  };
  return {place(d.originX, d.directionX), place(d.originY, d.directionY), d.directionX, d.directionY};
}

/// The differentials of the ray mirrored at a unit `normal`, which changes by normalX and normalY (14, 15).
inline Differentials mirrored(const Differentials& d, const Vec3& direction, const Vec3& normal,
                              const Vec3& normalX, const Vec3& normalY) {
  const Real along = dot(direction, normal);
  const auto turned = [&](const Vec3& turn, const Vec3& bend) {
    const Real change = dot(turn, normal) + dot(direction, bend);
    return turn - (bend * along + normal * change) * 2;
  };
  return {d.originX, d.originY, turned(d.directionX, normalX), turned(d.directionY, normalY)};
}

/// The differentials of the ray refracted from `direction` to `out`, both unit, at a unit `normal` that
/// points against `direction`. `ratio` = index before / index behind (16 to 19).
inline Differentials refracted(const Differentials& d, const Vec3& direction, const Vec3& out,
                               const Vec3& normal, Real ratio, const Vec3& normalX, const Vec3& normalY) {
  const Real in = dot(direction, normal), behind = dot(out, normal), mu = ratio * in - behind;
  const auto turned = [&](const Vec3& turn, const Vec3& bend) {
    const Real change = dot(turn, normal) + dot(direction, bend);
    return turn * ratio - bend * mu - normal * ((ratio - ratio * ratio * in / behind) * change);
  };
  return {d.originX, d.originY, turned(d.directionX, normalX), turned(d.directionY, normalY)};
}

}  // namespace trace
