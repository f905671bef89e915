// Where an object stands in a larger space.
#pragma once

#include "geometry/ray.h"
#include "math/transform.h"

namespace trace {

/// The way into an object's space for rays, and out of it for places on its surface.
class Placement {
 public:
  Placement() = default;  ///< the object's space is the outer one
  /// Precondition: invertible(outFromIn).
  explicit Placement(const Affine& outFromIn) : Placement(outFromIn, inverse(outFromIn)) {}
  Placement(const Affine& outFromIn, const Affine& inFromOut);

  bool moved() const { return moved_; }  ///< the transform is not the identity
  const Affine& outFromIn() const { return outFromIn_; }
  const Affine& inFromOut() const { return inFromOut_; }

  Ray into(const Ray& ray) const { return {inFromOut_ * ray.origin, linear(inFromOut_, ray.direction)}; }

  /// With the rounding of the way out, and of the way back that the next ray takes, added to the error.
  SurfacePoint outOf(const SurfacePoint& in) const {
    SurfacePoint out;
    out.point = outFromIn_ * in.point;
    out.error = (linear(size_, in.error) + rounding_ * abs(in.point)) * (1 + gammaError(24));
    const Vec3 normal = normalize(transposed(inFromOut_, in.normal));
    out.normal = normal;
    out.shading = in.shading == in.normal ? normal : normalize(transposed(inFromOut_, in.shading));
    out.uv = in.uv;
    return out;
  }

 private:
  Affine inFromOut_, outFromIn_;
  bool moved_ = false;
  Affine size_;      ///< outFromIn, every entry made positive
  Affine rounding_;  ///< of a place p: at most that of |p|
};

/// A point p goes out with an error of 4 roundings of M |p| + m, where M and m are the absolute values of the
/// transform's linear part and offset. The way back has 8 of N (M |p| + m) + n, likewise for the inverse,
/// which M brings out. Both are linear in |p|, and multiplied out here once.
inline Placement::Placement(const Affine& outFromIn, const Affine& inFromOut)
    : inFromOut_(inFromOut), outFromIn_(outFromIn), moved_(outFromIn != Affine{}) {
  size_ = absolute(outFromIn);
  const Affine there = size_, back = absolute(inFromOut), thereAndBack = back * there;
  for (int i = 0; i < 3; ++i)
    rounding_.row[i] = there.row[i] * gammaError(4) + transposed(thereAndBack, there.row[i]) * gammaError(8);
  rounding_.offset = there.offset * gammaError(4) + linear(there, thereAndBack.offset) * gammaError(8);
}

}  // namespace trace
