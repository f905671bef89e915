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

bool cameraSees(const Camera& camera) {
  return camera.fov > 0 && camera.fov < 180 && camera.aspectratio > 0 && isFinite(camera.position) &&
         canLook(camera.viewdir, camera.updir);
}

}  // namespace trace
