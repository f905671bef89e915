// Meshes close to analytic shapes, for formats that have no such shapes: exact at their points, with the
// shape's own normals. (tessellate.h is for looking at any shape.)
#pragma once

#include <optional>

#include "geometry/shape.h"

namespace trace {

/// In the shape's own space, with normals, curved sides in that many steps around. Nothing for shapes that
/// are meshes, have no end, or are not known here.
std::optional<MeshData> tessellated(const Shape& shape, int steps = 64);

}  // namespace trace
