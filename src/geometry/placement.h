// Where an object stands in a larger space.
#pragma once

#include <memory>
#include <variant>

#include "geometry/ray.h"
#include "math/transform.h"

namespace trace {

/// The way out of an object's space for places on its surface: a transform, and the rounding of it and of the
/// way back, which the next ray takes. The rounding at a place p is at most `rounding` of |p|.
struct WayOut {
  WayOut(const Affine& outFromIn, const Affine& inFromOut);

  Affine outFromIn, rounding;
};

/// The place in the outer space, with the rounding added to its error.
SurfacePoint outOf(const SurfacePoint& in, const WayOut& way, const Affine& inFromOut);

/// The way into an object's space for rays, and out of it for places on its surface. A scene may have a
/// million: one that scales along the axes and moves, as most do, is 12 numbers.
class Placement {
 public:
  Placement() : Placement(Affine{}) {}  ///< the object's space is the outer one
  /// Precondition: invertible(outFromIn).
  explicit Placement(const Affine& outFromIn);

  bool moved() const { return moved_; }  ///< the transform is not the identity
  Affine outFromIn() const;
  Affine inFromOut() const;

  Ray into(const Ray& ray) const {
    if (const Scaled* s = std::get_if<Scaled>(&way_))
      return {times(s->scaleIn, ray.origin) + s->offsetIn, times(s->scaleIn, ray.direction)};
    const Affine& inFromOut = std::get_if<Turned>(&way_)->inFromOut;
    return {inFromOut * ray.origin, linear(inFromOut, ray.direction)};
  }
  SurfacePoint outOf(const SurfacePoint& in) const {
    if (const Scaled* s = std::get_if<Scaled>(&way_)) return outOf(in, *s);
    const Turned* turned = std::get_if<Turned>(&way_);
    return trace::outOf(in, *turned->out, turned->inFromOut);
  }

 private:
  /// It scales along the axes and moves: then two thirds of a product are sums of zeros, which are left out.
  struct Scaled {
    Vec3 scaleIn, offsetIn, scaleOut, offsetOut;
  };
  /// Rays need the way in at once; the way out is asked for where they end.
  struct Turned {
    Affine inFromOut;
    std::shared_ptr<const WayOut> out;
  };

  static Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  static SurfacePoint outOf(const SurfacePoint& in, const Scaled& way);

  std::variant<Scaled, Turned> way_;
  bool moved_ = false;
};

}  // namespace trace
