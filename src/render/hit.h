// What a ray met, as an integrator sees it.
#pragma once

#include <cstdint>

#include "geometry/ray.h"
#include "shading/phong.h"

namespace trace {

class World;
struct Found;

struct Hit {
  /// What `ray` found in the world, around which there is `airIndex`.
  Hit(const World& world, const Ray& ray, const Found& found, Real airIndex);

  /// A ray from here in that direction.
  Ray leave(const Vec3& direction) const {
    Ray ray = spawnRay(surface, direction);
    if (convex && dot(direction, surface.normal) > 0) ray.leaves = object;
    return ray;
  }

  Real t;
  std::uint32_t object;  ///< index into Scene::objects
  std::uint64_t part;    ///< of the object: the crossing's part; of a mesh: the triangle
  SurfacePoint surface;
  Phong material;
  bool leaving;                   ///< the ray comes from inside: it runs along the true normal
  bool twoSided;                  ///< the surface is shaded from both sides
  bool convex;                    ///< the object is
  Real indexBefore, indexBehind;  ///< of refraction, on the ray's side and on the other
};

}  // namespace trace
