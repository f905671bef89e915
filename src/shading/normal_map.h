// Normal maps: pictures whose colours are directions in the frame of tangents of the surface.
#pragma once

#include <cmath>

#include "geometry/surface_slopes.h"
#include "math/color.h"

namespace trace {

/// The unit normal that a texel tells: red from 0 to 1 is the part along u from -1 to 1, green that along v,
/// blue that along `normal`, the unit one for shading. What lies along the surface is multiplied by `scale`.
/// Where green is turned round, as Direct3D has it, it counts downward. As in glTF 2.0, section 3.9.3; u and
/// v need not be at right angles. `normal` itself where u and v do not tell places apart.
inline Vec3 mappedNormal(const Color& texel, const TangentFrame& frame, const Vec3& normal, Real scale,
                         bool flipGreen) {
  const auto along = [&](const Vec3& step) { return normalize(step - normal * dot(step, normal)); };
  const Vec3 right = along(frame.u), up = cross(normal, right);
  const Real side = dot(up, frame.v) < 0 ? -1 : 1;  // a picture that is mirrored on the surface
  const Real x = 2 * texel.r - 1, y = (2 * texel.g - 1) * (flipGreen ? -side : side), z = 2 * texel.b - 1;
  const Vec3 bent = normalize(right * (scale * x) + up * (scale * y) + normal * z);
  return isFinite(bent) ? bent : normal;
}

}  // namespace trace
