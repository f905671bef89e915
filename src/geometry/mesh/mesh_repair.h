// Repairs that make meshes traceable, for their readers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/mesh/mesh.h"

namespace trace {

/// Appends the triangles of a polygon, whose corners are indices into mesh.points: a fan if that is right,
/// else ears cut off one by one, so that a polygon with dents keeps its shape; and notes that they are one.
/// Linear in the corners.
/// Precondition: every corner < mesh.points.size().
void appendPolygon(MeshData& mesh, std::span<const std::uint32_t> corners);

/// The warning of readers, with a place and the number, when dropDegenerate() has removed some.
inline constexpr std::string_view kWithoutArea = "triangles without area are left out";

/// The number of triangles without area, and the index of the first.
struct Degenerate {
  std::size_t count = 0, first = 0;
};

/// Removes triangles without area.
Degenerate dropDegenerate(MeshData& mesh);

/// A normal of length 0 becomes the mean of the unit normals of the faces around its point. (Where normals
/// are generated they are added to it anyway.) Returns how many.
std::size_t repairNormals(MeshData& mesh);

}  // namespace trace
