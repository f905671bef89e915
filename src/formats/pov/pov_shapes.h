// Helpers of the shapes of a POV-Ray scene.
#pragma once

#include "math/transform.h"

namespace trace::pov {

/// The rotation that takes z to the direction.
Affine along(const Vec3& direction);

}  // namespace trace::pov
