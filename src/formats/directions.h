// Checks of the directions of a camera before a reader makes one.
#pragma once

#include <cmath>

#include "math/transform.h"

namespace trace {

/// A length that normalize() can divide by.
inline bool hasDirection(const Vec3& v) {
  const Real l = length(v);
  return l > 0 && std::isfinite(l);
}

/// Parallel as far as arithmetic can tell.
inline bool parallel(const Vec3& a, const Vec3& b) {
  return !(length(cross(a, b)) > gammaError(8) * length(a) * length(b));
}

/// Do they span the picture of a camera?
inline bool canLook(const Vec3& viewdir, const Vec3& updir) {
  return hasDirection(viewdir) && hasDirection(updir) && !parallel(viewdir, updir);
}

}  // namespace trace
