// How texture coordinates and the normal change along a surface.
#pragma once

#include "math/vec.h"

namespace trace {

/// The steps along a surface over which u alone grows, and v alone.
struct TangentFrame {
  Vec3 u, v;
};

/// First derivatives at a place, in the space of the place.
struct SurfaceSlopes {
  Vec3 u, v;        ///< gradients, along the surface: over a small step d there, u grows by dot(u, d)
  Vec3 tangent[2];  ///< unit, at right angles to each other and to the true normal
  Vec3 normal[2];   ///< change of the normal for shading per unit of length along each

  /// Over a small step along the surface.
  Vec3 normalAlong(const Vec3& step) const {
    return normal[0] * dot(step, tangent[0]) + normal[1] * dot(step, tangent[1]);
  }
  /// The steps over which they grow by 1. Both are 0 where u and v do not tell places apart.
  TangentFrame frame() const { return {step(v, -1), step(u, 1)}; }

 private:
  Vec3 step(const Vec3& other, Real sign) const {
    const Vec3 outward = cross(tangent[0], tangent[1]);
    const Vec3 along = cross(outward, other) * (sign / dot(outward, cross(u, v)));
    return isFinite(along) ? along : Vec3{};
  }
};

}  // namespace trace
