// A hit point, as an integrator sees it.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "geometry/materials.h"
#include "geometry/ray.h"
#include "shading/bsdf.h"

namespace trace {

class World;
struct Found;

struct Hit {
  /// The hit of `ray` in the world.
  Hit(const World& world, const Ray& ray, const Found& found);

  /// A ray from here in that direction.
  Ray leave(const Vec3& direction) const {
    const bool leaves = convex && dot(direction, surface.normal) > 0;
    return {offsetPoint(surface, direction), direction, leaves ? object : Ray::kNothing};
  }

  /// Whether a ray of that direction arrives from behind: on the side of the facet from which the shading
  /// normal points away. The facet decides, because near the outline of a smooth mesh a shading normal may
  /// point away from a viewer of its front.
  bool isBehind(const Vec3& direction) const {
    return (dot(direction, surface.normal) > 0) != (dot(surface.shading, surface.normal) < 0);
  }

  Real t;
  std::uint32_t object;  ///< index into Scene::objects
  std::uint64_t part;    ///< the crossing's part of the object, or the triangle of a mesh
  SurfacePoint surface;
  Vec3 coat;              ///< the normal of a clear coat, where that is bent apart; otherwise 0
  Real opacity = 1;       ///< share of the surface that is there
  MaterialMix materials;  ///< materials of that share
  bool leaving;           ///< the ray comes from inside: it runs along the true normal
  bool twoSided;          ///< the surface is shaded from both sides
  bool convex;            ///< the object is
  bool strands;           ///< the object consists of strands
  bool solid;             ///< it encloses space
};

/// The Bsdf of a place, which may be made for it. Lives no longer than the World.
class PlaceBsdf {
 public:
  explicit PlaceBsdf(const Bsdf& only) : only_(&only) {}
  explicit PlaceBsdf(Bsdf&& own) : own_(std::move(own)) {}
  PlaceBsdf(const PlaceBsdf&) = delete;
  PlaceBsdf& operator=(const PlaceBsdf&) = delete;

  void replace(Bsdf bsdf) { own_ = std::move(bsdf); }

  const Bsdf& operator*() const { return own_ ? *own_ : *only_; }
  const Bsdf* operator->() const { return &**this; }

 private:
  const Bsdf* only_ = nullptr;
  std::optional<Bsdf> own_;
};

}  // namespace trace
