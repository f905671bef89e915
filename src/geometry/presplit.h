// Large triangles cut into several boxes before the hierarchy is built over them (Karras and Aila, Fast
// Parallel Construction of High-Quality Bounding Volume Hierarchies, HPG 2013, section 4: splitting
// triangles).
//
// A wall's triangle fills little of its box, and every ray through that box tests it. Cut boxes are tight.
// Scans, whose triangles are all small, gain nothing and are left alone.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh.h"

namespace trace {

/// Boxes, and the triangle that each holds a part of.
struct TriangleParts {
  std::vector<Box3> boxes;
  std::vector<std::uint32_t> triangles;

  void reserve(std::size_t count) { boxes.reserve(count), triangles.reserve(count); }
  void add(const Box3& box, std::uint32_t triangle) { boxes.push_back(box), triangles.push_back(triangle); }
};

/// The boxes of all triangles with area; some triangles in several parts, if that pays and `whole` is not
/// asked for.
TriangleParts triangleParts(const MeshData& mesh, bool whole = false);

}  // namespace trace
