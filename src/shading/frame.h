// The directions at a place of a surface that a material asks for.
#pragma once

#include "math/elementary.h"
#include "math/perpendicular.h"
#include "math/vec.h"

namespace trace {

/// Three unit vectors at right angles: x along the grain, y across it, z the normal.
struct Basis {
  Vec3 x, y, z;

  Vec3 toLocal(const Vec3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 toWorld(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

/// The data of a place; the rest is computed where a material asks for it.
struct Frame {
  Vec3 normal;          ///< unit, turned as the integrator shades it
  Vec3 along{};         ///< where u grows, of any length; 0 where that is not known or not asked
  bool inside = false;  ///< the normal was turned: it points into the body
  Vec3 coat{};          ///< the normal of a clear coat, turned likewise; 0: it is `normal`

  /// The grain lies in the surface and starts `along`, or in any one direction of the surface if that is 0;
  /// `angle` turns it about the normal, in radians against the clock as seen from outside.
  Basis basis(Real angle = 0) const {
    Vec3 x = along - normal * dot(along, normal);
    const Real l = length(x);
    x = l > 0 ? x / l : perpendicularTo(normal);
    Vec3 y = cross(normal, x);
    if (angle != 0) {
      const auto [s, c] = math::sincos(angle);
      const Vec3 turned = x * c + y * s;
      y = y * c - x * s;
      x = turned;
    }
    return {x, y, normal};
  }
};

}  // namespace trace
