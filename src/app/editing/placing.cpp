#include "app/editing/placing.h"

#include <cmath>

#include "formats/directions.h"

namespace trace {

Affine turned(const Affine& placed, const Vec3& degrees) {
  Affine result = placed;
  result.offset = {};
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i)
    if (degrees[i] != 0) result = Affine::rotation(axes[i], degrees[i] * kPi / 180) * result;
  result.offset = placed.offset;
  return result;
}

bool isFactor(Real factor) { return std::abs(factor) <= 1e6 && std::abs(factor) >= 1e-6; }

Affine stretched(const Affine& placed, const Vec3& factors) { return placed * Affine::scaling(factors); }

bool keepsObject(const Affine& placed) { return isFinite(placed.offset) && invertible(placed); }

Affine placedInSight(const Box3& bounds, const CameraFrame& camera, const Vec3& updir,
                     const std::optional<SurfacePoint>& there, Real ahead) {
  constexpr Real kShare = 0.25;  // share of the height of the picture
  const Real longest = maxComponent(bounds.size());
  if (bounds.empty() || bounds.unbounded() || !(longest > 0)) return {};
  const Vec3 at = there ? there->point : camera.eye + normalize(camera.look) * ahead;
  const Real distance = there ? length(at - camera.eye) : ahead;
  const Real size = kShare * distance * length(camera.up) / length(camera.look);
  const Real factor = size / longest;
  // Up is an axis of the world, the one that the camera has for it.
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(updir[i]) > std::abs(updir[axis])) axis = i;
  Vec3 up;
  up[axis] = updir[axis] < 0 ? -1 : 1;
  Vec3 side = up;
  if (there) {
    const Vec3 facing = dot(there->normal, at - camera.eye) > 0 ? -there->normal : there->normal;
    if (dot(facing, up) < 0.5) side = facing;  // a wall: before it, not on it
  }
  const Vec3 half = bounds.size() * (factor / 2);
  const Real reach = std::abs(side.x) * half.x + std::abs(side.y) * half.y + std::abs(side.z) * half.z;
  const Vec3 middle = there ? at + side * reach : at;
  return Affine::translation(middle - bounds.center() * factor) * Affine::scaling(Vec3(1, 1, 1) * factor);
}

bool cameraSees(const Camera& camera) {
  return camera.fov > 0 && camera.fov < 180 && camera.aspectratio > 0 && isFinite(camera.position) &&
         canLook(camera.viewdir, camera.updir);
}

}  // namespace trace
