// What a ray met, as an integrator sees it.
#pragma once

#include <cstdint>

#include "geometry/ray.h"
#include "shading/phong.h"

namespace trace {

struct Hit {
  Real t = 0;
  std::uint32_t object = 0;  ///< index into Scene::objects
  std::uint64_t part = 0;    ///< of the object: the crossing's part; of a mesh: the triangle
  SurfacePoint surface;
  Phong material;
  bool leaving = false;                   ///< the ray comes from inside: it runs along the true normal
  bool twoSided = false;                  ///< the surface is shaded from both sides
  Real indexBefore = 1, indexBehind = 1;  ///< of refraction, on the ray's side and on the other
};

}  // namespace trace
