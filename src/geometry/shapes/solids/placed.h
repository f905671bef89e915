// A shape in its place within a larger one: the operands of CSG, the parts of a blend.
#pragma once

#include <memory>

#include "geometry/mesh/mesh_tree.h"
#include "geometry/placement.h"
#include "geometry/traced.h"

namespace trace {

/// The bounds of a shape seen from outside of its transform; everywhere if they have no end.
Box3 placedBounds(const Box3& bounds, const Affine& outFromIn);

/// A shape and the transform out of its space. Precondition: the transform can be undone.
class Placed {
 public:
  /// The hierarchy of a mesh is taken from those `made`, if it is there.
  Placed(const Shape& shape, const Affine& outFromIn, const MeshTrees& made = {});

  bool solid() const { return mesh_ || shape_.solid(); }
  ShapeFacts facts() const { return {solid(), bounds_, shape_.partCount()}; }
  const Box3& bounds() const { return bounds_; }
  /// Every crossing of the ray's line, in any order.
  void crossings(const Ray& ray, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  const TracedShape& shape() const { return shape_; }
  /// The tree of a mesh; null for other shapes.
  const std::shared_ptr<const MeshTree>& meshTree() const { return mesh_; }

 private:
  Ray inner(const Ray& ray) const { return placement_.moved() ? placement_.into(ray) : ray; }

  TracedShape shape_;
  Placement placement_;
  Box3 bounds_;
  std::shared_ptr<const MeshTree> mesh_;
};

}  // namespace trace
