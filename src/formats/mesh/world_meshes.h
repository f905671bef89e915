// The meshes of a scene brought to world space, for formats that hold nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "scene/scene.h"

namespace trace {

struct WorldMesh {
  std::string name;
  std::uint32_t material;
  MeshData mesh;  ///< with generated normals, if it asks for them; triangles face outward again if mirrored
};

/// Other shapes become triangles. Warns of that, of camera, lights and the like, which no mesh has, and of
/// what has no end and is left out, by kinds. Throws Error(Fault::scene) if nothing is left.
std::vector<WorldMesh> worldMeshes(const Scene& scene, Messages& messages);

/// The picture that is all of the material's paint, as files of meshes can say it: on diffuse, or what is
/// called color, and perhaps on ambient, lying as the texture coordinates have it. Null if there is none.
const ImageMap* pictureOf(const Material& material);

/// The mesh with three points of its own for each triangle, and the faces' normals.
MeshData withFlatNormals(const MeshData& mesh);

}  // namespace trace
