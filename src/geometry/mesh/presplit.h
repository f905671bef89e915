// Large triangles cut into several boxes before the hierarchy is built over them (Karras and Aila, Fast
// Parallel Construction of High-Quality Bounding Volume Hierarchies, HPG 2013, section 4: splitting
// triangles).
//
// A wall's triangle fills little of its box, and every ray through that box tests it. Cut boxes are tight.
// Scans, whose triangles are all small, gain nothing and are left alone.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/boxed_item.h"
#include "geometry/mesh/mesh.h"

namespace trace {

/// The boxes of all triangles with area; some triangles in several parts, if that pays and `whole` is not
/// asked for.
std::vector<BoxedItem> triangleParts(const MeshData& mesh, bool whole = false);

}  // namespace trace
