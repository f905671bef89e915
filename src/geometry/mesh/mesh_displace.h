// Meshes whose points are moved along their normals (Cook, Shade Trees, SIGGRAPH 1984, section 5).
#pragma once

#include <cstdint>
#include <functional>

#include "geometry/mesh/mesh.h"

namespace trace {

/// How far the point of that number in the mesh that is asked moves, in the mesh's space.
using HeightOfPoint = std::function<Real(const MeshData& mesh, std::uint32_t point)>;

/// Each triangle cut in four, `levels` times, at the middles of its edges; then every point moved along its
/// normal by its height, and normals made anew. uv and normals are mixed, and a new point takes the material
/// of one end of its edge.
///
/// No crack opens: points at one place move together, by the mean of their heights, along the mean of their
/// normals; where these cancel they stay. Without normals the mesh has those that are smooth across all
/// edges. Points at one place keep a sharp edge between them if their normals differed before. Throws
/// Error(Fault::scene), without a place, if a point comes to lie beyond what a float holds.
/// Precondition: 4^levels times the triangles fits into 32 bits.
MeshData displaced(const MeshData& mesh, int levels, const HeightOfPoint& height);

}  // namespace trace
