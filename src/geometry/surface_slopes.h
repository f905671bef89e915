// How texture coordinates and the normal change along a surface.
#pragma once

#include "math/vec.h"

namespace trace {

/// First derivatives at a place, in the space of the place.
struct SurfaceSlopes {
  Vec3 u, v;        ///< gradients, along the surface: over a small step d there, u grows by dot(u, d)
  Vec3 tangent[2];  ///< unit, at right angles to each other and to the true normal
  Vec3 normal[2];   ///< change of the normal for shading per unit of length along each

  /// Over a small step along the surface.
  Vec3 normalAlong(const Vec3& step) const {
    return normal[0] * dot(step, tangent[0]) + normal[1] * dot(step, tangent[1]);
  }
  /// The steps along the surface over which u alone grows by 1, and v alone: the frame of tangents. Both are
  /// 0 where u and v do not tell places apart.
  Vec3 byU() const { return frame(v, -1); }
  Vec3 byV() const { return frame(u, 1); }

 private:
  Vec3 frame(const Vec3& other, Real sign) const {
    const Vec3 outward = cross(tangent[0], tangent[1]);
    const Vec3 step = cross(outward, other) * (sign / dot(outward, cross(u, v)));
    return isFinite(step) ? step : Vec3{};
  }
};

}  // namespace trace
