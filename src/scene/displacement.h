// The displacement of a mesh by its materials: `displacement` and `displacement_levels`.
//
// compile() (render/world/world.h) and the writers of mesh formats ask for it; the Scene keeps the mesh as it
// was given.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "scene/scene.h"
#include "shading/material.h"

namespace trace {

class Displacement {
 public:
  /// More triangles than this are not made of a mesh.
  static constexpr std::size_t kMostTriangles = 50'000'000;

  /// None.
  Displacement() = default;
  /// For an object of that material, whose points may be of others.
  Displacement(const MeshData& mesh, std::uint32_t material, std::span<const Material> materials);

  bool none() const { return parts_.empty(); }
  /// Some height is sure to lie in u and v.
  bool wantsUv() const;
  bool operator==(const Displacement&) const = default;

  /// The mesh displaced, with the levels of the finest of its materials. Throws Error(Fault::limit) if it
  /// would have too many triangles, and as displaced() of geometry/mesh/mesh_displace.h; at `place`.
  MeshData of(const MeshData& mesh, const SourcePlace& place) const;

 private:
  struct Part {
    std::uint32_t material = 0;  ///< material of points; 0 where all are of one
    Real height = 0;
    std::optional<Texture> texture{};
    bool operator==(const Part&) const = default;
  };
  int levels_ = 0;
  std::vector<Part> parts_;  ///< in the order of materials; only those that move points
};

/// The mesh of an object as its materials displace it; null where it is no mesh. Shared with the object if
/// they do not. Throws as Displacement::of().
std::shared_ptr<const MeshData> displacedMesh(const Object& object, std::span<const Material> materials);

}  // namespace trace
