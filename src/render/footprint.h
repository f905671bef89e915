// How the footprint of a ray goes on where it is mirrored or refracted.
#pragma once

#include "render/world.h"
#include "shading/differentials.h"

namespace trace {

/// The changes of a unit normal for shading, on either side, over the footprint of a ray that arrived.
struct NormalChange {
  Vec3 x, y;
  NormalChange(const World& world, const Hit& hit, const Vec3& normal, const Differentials& arrived) {
    const SurfaceSlopes slopes = world.slopes(hit);
    const Real side = dot(normal, hit.surface.shading) < 0 ? -1 : 1;
    x = slopes.normalAlong(arrived.originX) * side, y = slopes.normalAlong(arrived.originY) * side;
  }
};

inline Differentials mirroredAt(const World& world, const Hit& hit, const Differentials& arrived,
                                const Vec3& direction, const Vec3& normal) {
  const NormalChange change(world, hit, normal, arrived);
  return mirrored(arrived, direction, normal, change.x, change.y);
}

/// From `direction` to `out`; `ratio` = index before / index behind.
inline Differentials refractedAt(const World& world, const Hit& hit, const Differentials& arrived,
                                 const Vec3& direction, const Vec3& out, const Vec3& normal, Real ratio) {
  const NormalChange change(world, hit, normal, arrived);
  return refracted(arrived, direction, out, normal, ratio, change.x, change.y);
}

}  // namespace trace
