// The same mesh with more or fewer triangles, for how time grows with their number.
#pragma once

#include "geometry/mesh/mesh.h"

namespace trace::bench {

/// About as many triangles as asked for: fewer by merging the points of each cell of a grid (Rossignac and
/// Borrel 1993), more by cutting each triangle into four, as often as needed to reach the number.
MeshData resized(const MeshData& mesh, std::size_t triangles);

}  // namespace trace::bench
