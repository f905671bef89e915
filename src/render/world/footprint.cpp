#include "render/world/footprint.h"

namespace trace {
namespace {

/// The change of a normal for shading, on either side, over the footprint.
struct NormalChange {
  Vec3 x, y;
  NormalChange(const World& world, const Hit& hit, const Vec3& normal, const Differentials& arrived) {
    const SurfaceSlopes slopes = world.slopes(hit);
    const Real side = dot(normal, hit.surface.shading) < 0 ? -1 : 1;
    x = slopes.normalAlong(arrived.originX) * side;
    y = slopes.normalAlong(arrived.originY) * side;
  }
};

}  // namespace

Footprint arrivedAt(const Hit& hit, const Differentials& ray, const Vec3& direction) {
  return arrived(ray, direction, hit.t, hit.surface.normal);
}

Footprint mirroredAt(const World& world, const Hit& hit, const Differentials* arrived, const Vec3& direction,
                     const Vec3& normal) {
  if (!arrived) return {};
  const NormalChange change(world, hit, normal, *arrived);
  return mirrored(*arrived, direction, normal, change.x, change.y);
}

Footprint refractedAt(const World& world, const Hit& hit, const Differentials* arrived, const Vec3& direction,
                      const Vec3& out, const Vec3& normal, Real ratio) {
  if (!arrived) return {};
  const NormalChange change(world, hit, normal, *arrived);
  return refracted(*arrived, direction, out, normal, ratio, change.x, change.y);
}

}  // namespace trace
