// The traced form of a shape, whatever its type: the shape itself, or data computed from it. The
// World goes a shorter way (render/world/world_queries.cpp).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/materials.h"
#include "geometry/ray.h"
#include "geometry/shape.h"
#include "math/box.h"

namespace trace {

struct MeshData;

class TracedShape {
 public:
  struct Held;  ///< complete with shape_list.h
  TracedShape(const ShapeType& type, std::shared_ptr<const Held> held)
      : type_(&type), held_(std::move(held)) {}

  const ShapeType& type() const { return *type_; }
  const Held& held() const { return *held_; }
  /// Null unless it is a mesh, of which nothing else is to be asked but its bounds: who traces it keeps its
  /// MeshTree.
  std::shared_ptr<const MeshData> mesh() const;

  // The contract is in shape_list.h.
  bool solid() const;
  Box3 bounds() const;
  /// Visits the crossings in the range, in any order, and perhaps others. A shape that takes no range gives
  /// all.
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  bool convex() const;
  bool strands() const;

  /// Parts of it are of other materials than the whole.
  bool ofSeveralMaterials() const;
  MaterialMix material(std::int64_t part, std::uint32_t own) const;
  void addMaterials(std::vector<std::uint32_t>& all) const;
  /// The medium inside the shape at that part of its surface, which may be of another material.
  MaterialMix inside(std::int64_t part, std::uint32_t own) const;

  /// Its parts are numbered below this.
  std::int64_t partCount() const;
  /// Adds the trees of its operands that are meshes, however deep.
  void addMeshTrees(MeshTrees& trees) const;

 private:
  const ShapeType* type_;
  std::shared_ptr<const Held> held_;
};

/// Facts about a shape before anything is built of it.
struct ShapeFacts {
  bool solid = false;  ///< a mesh counts as one: the World warns of those that are not closed
  Box3 bounds{};       ///< holds the shape, perhaps with room left
  std::int64_t partCount = 0;
};

/// Throws Error for a shape that cannot be traced, as prepare() does. Hierarchies of meshes and heights of
/// terrains are not built for it.
ShapeFacts check(const Shape& shape);

/// The traced form of the shape. Solids of solids take over the hierarchies of meshes that are `made`. Throws
/// Error for a shape that cannot be traced.
TracedShape prepare(const Shape& shape, const MeshTrees& made = {});

}  // namespace trace
