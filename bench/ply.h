// Binary little-endian PLY, as far as the meshes of the benchmarks use it: float or double positions, and
// faces as a list of indices, fanned into triangles.
#pragma once

#include <string>

#include "geometry/mesh/mesh.h"

namespace trace::bench {

/// The mesh with every coordinate multiplied by `scale`. Throws Error for what it cannot read.
MeshData readPly(const std::string& path, double scale = 1);

}  // namespace trace::bench
