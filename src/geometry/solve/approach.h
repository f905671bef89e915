// Rays from far away, taken up where they come near.
//
// A place o + t d is known to a few units in the last place of |o| and t |d|. From a thousand sizes away that
// is far coarser than what a search for the surface tells apart, so the search would find crossings that are
// not there. The same line, started where it passes nearest to the object, has all its digits there. What is
// lost once, in t, is added to the error of the place that is found.
#pragma once

#include "geometry/ray.h"
#include "math/box.h"

namespace trace {

class Approach {
 public:
  Approach() = default;  ///< no ray comes from far away
  /// To what lies within `bounds`, which may be empty or infinite: then no ray comes from far away.
  explicit Approach(const Box3& bounds);

  /// The t at which the ray is taken up; 0 if it starts near enough.
  Real start(const Ray& ray) const {
    const Vec3 way = center_ - ray.origin;
    if (!(dot(way, way) > far_)) return 0;
    const Real t = dot(way, ray.direction) / dot(ray.direction, ray.direction);
    return isFinite(ray.at(t)) ? t : 0;
  }
  /// The ray taken up there: the one whose t is as much less.
  static Ray from(Real start, const Ray& ray) {
    return start == 0 ? ray : Ray{ray.at(start), ray.direction, ray.leaves};
  }
  /// How far a place found at `t` may lie from the one meant, by the rounding of t alone.
  static Vec3 rounding(Real start, Real t, const Ray& ray) {
    return start == 0 ? Vec3{} : abs(ray.direction) * (std::abs(t) * gammaError(2));
  }

 private:
  /// Sizes away. Nearer rays are followed from where they start: what is found bounds their rounding too.
  static constexpr Real kFar = 32;

  Vec3 center_;
  Real far_ = kInfinity;  ///< square of the distance
};

inline Approach::Approach(const Box3& bounds) {
  if (bounds.empty() || bounds.unbounded()) return;
  const Vec3 size = bounds.size();
  center_ = bounds.center();
  far_ = kFar * kFar * dot(size, size);
}

}  // namespace trace
