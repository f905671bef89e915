// Where the nodes of a glTF file stand at a moment, and how its meshes are bent: animations, morph targets
// and skins. Source: Khronos Group, glTF 2.0 Specification, sections 3.7.2.2, 3.7.3 and 3.11, and appendix C;
// and EXT_mesh_gpu_instancing.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "formats/mesh/gltf/document/gltf_elements.h"
#include "formats/scene_time.h"
#include "math/transform.h"

namespace trace {

struct MeshData;

/// Reads an accessor whose number is sound.
using ReadAccessor = std::function<GltfElements(int)>;

/// The node's own transform, in its parent.
Affine transformOf(const tinygltf::Node& node);

/// Sets translation, rotation, scale and weights of all nodes as the first animation has them at the time.
/// Before its first key and after its last it holds. Returns the seconds of these; asks for the time if there
/// is a key. Throws Error(Fault::scene) for accessors that are not as they should be.
std::optional<std::pair<Real, Real>> animate(tinygltf::Model& gltf, SceneTime& time,
                                             const ReadAccessor& elements, const SourcePlace& place);

/// The transforms that place the node's copies in the node, by EXT_mesh_gpu_instancing; one that changes
/// nothing without it. Throws as animate().
std::vector<Affine> instancesOf(const tinygltf::Node& node, const ReadAccessor& elements,
                                const SourcePlace& place);

/// Bends the meshes of a file whose nodes stand still.
class GltfPose {
 public:
  GltfPose(const tinygltf::Model& gltf, ReadAccessor elements, const SourcePlace& place);

  /// Whether the node's mesh is another one than it would be for a node without skin and weights.
  bool bends(const tinygltf::Node& node) const;
  /// A mesh with a skin stands in the world, wherever its node does.
  bool isInWorld(const tinygltf::Node& node) const { return node.skin >= 0; }

  /// Moves points, normals and tangents of the primitive, all of which are there: first by the morph targets,
  /// then by the joints. Returns the number of joints that a point names and its skin lacks; they are left
  /// out.
  std::size_t bend(const tinygltf::Node& node, const tinygltf::Primitive& primitive, MeshData& mesh);

 private:
  void morph(const std::vector<double>& weights, const tinygltf::Primitive& primitive, MeshData& mesh) const;
  std::size_t applySkin(int skin, const tinygltf::Primitive& primitive, MeshData& mesh);
  const std::vector<Affine>& jointsOf(int skin);
  [[noreturn]] void fail(const std::string& what) const;

  const tinygltf::Model& gltf_;
  ReadAccessor elements_;
  const SourcePlace& place_;
  std::vector<Affine> worldFromNode_;          ///< world from node of each node
  std::map<int, std::vector<Affine>> joints_;  ///< skins: from the modelled mesh to the world
};

}  // namespace trace
