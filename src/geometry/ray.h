// Rays, and what a shape tells of a place on its surface.
#pragma once

#include <concepts>
#include <cstdint>

#include "geometry/solve/surface_uv.h"
#include "math/vec.h"

namespace trace {

/// The points origin + t direction, t > 0. The direction need not be a unit vector.
struct Ray {
  static constexpr std::uint32_t kNothing = 0xffffffffu;

  Vec3 origin, direction;
  std::uint32_t leaves = kNothing;  ///< the number of a convex object that lies behind it, and is not asked
  Vec3 at(Real t) const { return origin + direction * t; }
};

/// Where the line of a ray passes through a surface.
struct Crossing {
  Real t = 0;
  std::int64_t part = 0;  ///< which face, cap or triangle of the shape; the shape's own numbering

  /// Nearer first; at the same distance the earlier part.
  bool before(const Crossing& other) const { return t != other.t ? t < other.t : part < other.part; }
};

/// The crossings that a query still wants: those at from < t <= to, which may shrink while they are visited.
struct Range {
  Real from;
  const Real& to;
};

/// Anything that takes a Crossing, behind a plain call: for shapes that are traced in a .cpp.
class VisitCrossing {
 public:
  template <class Visit>
  requires(!std::same_as<Visit, VisitCrossing>)  // which is copied, not called by another
      VisitCrossing(Visit& visit)                // NOLINT(google-explicit-constructor)
      : context_(const_cast<void*>(static_cast<const void*>(&visit))),
        call_([](void* context, const Crossing& c) { (*static_cast<Visit*>(context))(c); }) {}
  void operator()(const Crossing& crossing) const { call_(context_, crossing); }

 private:
  void* context_;
  void (*call_)(void*, const Crossing&);
};

/// A place on a surface, in the space of the ray that found it.
///
/// No epsilons: `error` bounds, per coordinate, how far `point` may lie from the true surface and how far
/// arithmetic near it may be off, so that a ray started at offsetPoint() is surely on its side of it.
struct SurfacePoint {
  Vec3 point;
  Vec3 error;
  Vec3 normal;   ///< unit, of the true surface; outward for solids, toward the ray's origin for open sheets
  Vec3 shading;  ///< unit; differs from `normal` where a mesh has vertex normals
  SurfaceUv uv;
};

/// The point moved off the surface along its normal, to the side that `direction` leaves toward (pbrt 4th
/// ed., 6.8.6): far enough to be past the error bounds, near enough to be invisible at any scale.
inline Vec3 offsetPoint(const SurfacePoint& surface, const Vec3& direction) {
  const Real distance = dot(abs(surface.normal), surface.error);
  const Real side = dot(direction, surface.normal) < 0 ? -1 : 1;
  const Vec3 move = surface.normal * side, p = surface.point + move * distance;
  return {onward(p.x, move.x), onward(p.y, move.y), onward(p.z, move.z)};
}

inline Ray spawnRay(const SurfacePoint& surface, const Vec3& direction) {
  return {offsetPoint(surface, direction), direction};
}

}  // namespace trace
