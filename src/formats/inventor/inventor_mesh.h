// Polygons whose corners each have their own normal, material and texture coordinate, made into a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace trace::inventor {

struct Corner {
  std::uint32_t point = 0;
  Vec3 normal;
  std::uint32_t material = 0;
  Vec2 uv;
};

struct Faces {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> counts;  ///< corners of each polygon
  std::vector<Corner> corners;        ///< corners of all polygons in turn; their points exist
  bool hasNormals = false, hasMaterials = false, hasUvs = false;
  bool counterClockwise = true;
  /// Without normals, those of faces that meet at a smaller angle than this, in radians, are mixed.
  Real creaseAngle = 0;
};

/// Corners that are the same become one point. Faces look flat where there are no normals to mix. May hold
/// triangles without area.
MeshData meshOf(Faces faces);

}  // namespace trace::inventor
