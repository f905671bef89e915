// The meshes of a scene brought to world space, for formats that hold nothing else.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "scene/scene.h"
#include "shading/textures/image_map.h"

namespace trace {

struct WorldMesh {
  std::string name;
  std::uint32_t material;
  MeshData mesh;  ///< with generated normals, if it asks for them; triangles face outward again if mirrored
};

/// Makes triangles of shapes for a file that does not know them, in WriteOptions::steps, and remembers what
/// became of them.
class ShapeTriangles {
 public:
  explicit ShapeTriangles(int steps) : wanted_(steps > 0), steps_(wanted_ ? steps : 64), fewest_(steps_) {}

  /// With the texture coordinates of the shape if it is `mapped`. Nothing where tessellated() has none.
  std::optional<MeshData> of(const Shape& shape, bool mapped);
  void leaveOut(const Shape& shape) { ++leftOut_[std::string(shape.keyword())]; }
  /// Warns that all shapes but the `known` became triangles, of too few steps, and of what was left out, by
  /// kinds. Throws Error(Fault::scene) if `nothing` is left.
  void report(const SourcePlace& place, const std::string& known, bool nothing, Messages& messages) const;

 private:
  bool wanted_, any_ = false;
  int steps_, fewest_;
  std::map<std::string, std::size_t> leftOut_;  // by keyword
};

/// Other shapes become triangles. Warns of that, of camera, lights and the like, which no mesh has, and of
/// what has no end and is left out, by kinds. Throws Error(Fault::scene) if nothing is left.
std::vector<WorldMesh> worldMeshes(const Scene& scene, const WriteOptions& options, Messages& messages);

/// The picture that is all of the material's paint, as files of meshes can say it: on diffuse, or what is
/// called color, and perhaps on ambient, lying as the texture coordinates have it. Null if there is none.
const ImageMap* pictureOf(const Material& material);

/// The mesh with three points of its own for each triangle, and the faces' normals.
MeshData withFlatNormals(const MeshData& mesh);

}  // namespace trace
