// What a ray sees that meets a light, of those that are seen.
#pragma once

#include <optional>

#include "geometry/ray.h"
#include "math/color.h"

namespace trace {

struct LightSeen {
  Real t;       ///< along the ray
  Color color;  ///< its radiance
};

}  // namespace trace
