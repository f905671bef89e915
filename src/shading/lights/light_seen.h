// The radiance of a ray that hits a visible light.
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
