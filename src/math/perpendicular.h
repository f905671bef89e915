// Directions at right angles to a given one.
#pragma once

#include "math/vec.h"

namespace trace {

/// A unit vector perpendicular to the unit vector n: its cross product with the axis of x, or with that of y
/// where n leans towards x. The cross product of n and the result completes an orthonormal basis. (Duff et
/// al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017, have a form without the root; it gives
/// other vectors, and with them other pictures.)
inline Vec3 perpendicularTo(const Vec3& n) {
  return normalize(cross(n, std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
}

}  // namespace trace
