// Meshes close to analytic shapes, for formats that have no such shapes. Those of the courses exactly, point
// by point, with the shape's own normals; any other out of its crossings, as tessellate.h draws it.
#pragma once

#include <optional>

#include "geometry/shape.h"

namespace trace {

/// In the shape's own space, with normals, in that many steps around or along its longest side. Nothing for a
/// shape that is a mesh, or has no end, or nothing to see, or finer folds than can be followed. `mapped`:
/// with the texture coordinates of the shape. `followed` and `wanted` are those of tessellate().
std::optional<MeshData> tessellated(const Shape& shape, int steps = 64, bool mapped = false,
                                    int* followed = nullptr, bool wanted = false);

}  // namespace trace
