// Texture coordinates for any mesh, projected from around it.
#pragma once

#include <optional>
#include <string_view>

#include "geometry/mesh/mesh.h"

namespace trace {

/// By the directions and the size of the mesh's bounding box; the axis is z, as for spheres and cylinders.
enum class UvProjection {
  spherical,    ///< longitude and latitude as seen from the box's centre, 0 to 1
  cylindrical,  ///< longitude, and height in the box, 0 to 1
  planar,       ///< x and y in the box, 0 to 1
  cubic,        ///< each face from the side it faces most; 1 is the box's longest side
};

/// The projection of that name.
std::optional<UvProjection> uvProjection(std::string_view name);

/// The mesh with uv in place of its own. Where faces go across the line from u = 1 back to 0, or turn to
/// another side, points are doubled, and u continues above 1. Normals to be generated are, with length 1.
MeshData withProjectedUvs(const MeshData& mesh, UvProjection projection);

}  // namespace trace
