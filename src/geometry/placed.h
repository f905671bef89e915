// A shape in its place within a larger one: the operands of CSG, the parts of a blend.
#pragma once

#include <memory>

#include "geometry/mesh_tree.h"
#include "geometry/traced.h"
#include "math/transform.h"

namespace trace {

/// A place on an object brought out of the object's space, with the rounding of the way there and of the way
/// back, which the next ray takes, added to its error.
inline SurfacePoint transformed(const SurfacePoint& in, const Affine& outFromIn, const Affine& inFromOut) {
  const Vec3 size = absLinear(outFromIn, abs(in.point)) + abs(outFromIn.offset);
  const Vec3 back = (absLinear(inFromOut, size) + abs(inFromOut.offset)) * gammaError(8);
  SurfacePoint out;
  out.point = outFromIn * in.point;
  out.error = (size * gammaError(4) + absLinear(outFromIn, in.error + back)) * (1 + gammaError(8));
  out.normal = normalize(transposed(inFromOut, in.normal));
  out.shading = in.shading == in.normal ? out.normal : normalize(transposed(inFromOut, in.shading));
  out.uv = in.uv;
  return out;
}

/// A shape and the transform out of its space. Precondition: the transform can be undone.
class Placed {
 public:
  /// The hierarchy of a mesh is taken from those `made`, if it is there.
  Placed(const Shape& shape, const Affine& outFromIn, const MeshTrees& made = {});

  bool solid() const;
  const Box3& bounds() const { return bounds_; }
  /// Every crossing of the ray's line, in any order.
  void crossings(const Ray& ray, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  /// The shape's parts are numbered below this.
  std::int64_t partCount() const;
  const TracedShape& shape() const { return shape_; }
  /// Of a mesh; null for other shapes.
  const std::shared_ptr<const MeshTree>& meshTree() const { return mesh_; }

 private:
  Ray inner(const Ray& ray) const {
    return moved_ ? Ray{inFromOut_ * ray.origin, linear(inFromOut_, ray.direction)} : ray;
  }

  TracedShape shape_;
  Affine outFromIn_, inFromOut_;
  bool moved_ = false;
  Box3 bounds_;
  std::shared_ptr<const MeshTree> mesh_;
};

}  // namespace trace
