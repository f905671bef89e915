// How a person turns and stretches an object, in steps that multiply what is there.
#pragma once

#include "math/transform.h"

namespace trace {

/// Turned about the axes x, y and z, in this order, through the object's origin, which stays; degrees.
Affine turned(const Affine& placed, const Vec3& degrees);

/// Stretched along the object's own axes. A factor that would leave nothing to see, or to take back, counts
/// as 1.
Affine stretched(const Affine& placed, const Vec3& factors);

}  // namespace trace
