// Whether a mesh encloses space.
#pragma once

#include "geometry/mesh/mesh.h"

namespace trace {

/// Every edge has as many triangles on the one side as on the other; corners at one place count as one. False
/// for a mesh without triangles.
bool closed(const MeshData& mesh);

}  // namespace trace
