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

  Ray into(const Ray& ray) const {
    if (!aligned_) return {inFromOut_ * ray.origin, linear(inFromOut_, ray.direction)};
    const Vec3 scale = diagonal(inFromOut_);
    return {times(scale, ray.origin) + inFromOut_.offset, times(scale, ray.direction)};
  }

  /// With the rounding of the way out, and of the way back that the next ray takes, added to the error.
  SurfacePoint outOf(const SurfacePoint& in) const {
    if (aligned_) {
      const Vec3 scale = diagonal(inFromOut_);
      return outOf(
          in, [](const Affine& m, const Vec3& v) { return times(diagonal(m), v); },
          [&](const Vec3& n) { return times(scale, n); });
    }
    return outOf(
        in, [](const Affine& m, const Vec3& v) { return linear(m, v); },
        [&](const Vec3& n) { return transposed(inFromOut_, n); });
  }

 private:
  static Vec3 diagonal(const Affine& m) { return {m.row[0].x, m.row[1].y, m.row[2].z}; }
  static Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

  /// `product` is that of a linear part and a vector, `turned` what becomes of the direction of a normal.
  template <class Product, class Turned>
  SurfacePoint outOf(const SurfacePoint& in, const Product& product, const Turned& turned) const {
    SurfacePoint out;
    out.point = product(outFromIn_, in.point) + outFromIn_.offset;
    const Affine size = absolute(outFromIn_);
    out.error = (product(size, in.error) + (product(rounding_, abs(in.point)) + rounding_.offset)) *
                (1 + gammaError(24));
    // By components: a copy of numbers that were just written would wait for memory.
    const Vec3 normal = normalize(turned(in.normal));
    Vec3 shading{normal.x, normal.y, normal.z};
    if (!(in.shading == in.normal)) shading = normalize(turned(in.shading));
    out.normal = normal;
    out.shading = shading;
    out.uv = in.uv;
    return out;
  }

  Affine inFromOut_, outFromIn_;
  bool moved_ = false;
  /// It scales along the axes and moves, as most do: then two thirds of a product are sums of zeros, which
  /// are left out.
  bool aligned_ = false;
  Affine rounding_;  ///< rounding at a place p: at most that of |p|
};

/// A point p goes out with an error of 4 roundings of M |p| + m, where M and m are the absolute values of the
/// transform's linear part and offset. The way back has 8 of N (M |p| + m) + n, likewise for the inverse,
/// which M brings out. Both are linear in |p|, and multiplied out here once.
inline Placement::Placement(const Affine& outFromIn, const Affine& inFromOut)
    : inFromOut_(inFromOut), outFromIn_(outFromIn), moved_(outFromIn != Affine{}) {
  const auto scales = [](const Affine& m) {
    Affine only = Affine::scaling(diagonal(m));
    only.offset = m.offset;
    return m == only;
  };
  aligned_ = scales(outFromIn) && scales(inFromOut);
  const Affine there = absolute(outFromIn), back = absolute(inFromOut), thereAndBack = back * there;
  for (int i = 0; i < 3; ++i)
    rounding_.row[i] = there.row[i] * gammaError(4) + transposed(thereAndBack, there.row[i]) * gammaError(8);
  rounding_.offset = there.offset * gammaError(4) + linear(there, thereAndBack.offset) * gammaError(8);
}

}  // namespace trace
