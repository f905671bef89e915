// The test of four triangles at once, and a ray's way through the blocks of a mesh. Compiled once for each
// instruction set (mesh_kernel_*.cpp), hence inside the namespace of simd.h and free of the standard library.
#pragma once

#include "accel/traverse.h"
#include "geometry/mesh_tree.h"

namespace trace::simd {
#if defined(__AVX2__)
inline namespace avx2 {
#elif defined(__SSE2__)
inline namespace sse2 {
#else
inline namespace plain {
#endif

/// The lanes whose triangle the ray meets, or may meet as far as rounding goes. The same arithmetic as in
/// TriangleRay::intersect: corners sheared into the plane across the ray, the three edges' sides.
inline unsigned lanesMet(const TriangleBlock& block, const LaneRay& ray) {
  const Double4 originX = Double4::all(ray.origin[ray.x]), originY = Double4::all(ray.origin[ray.y]),
                originZ = Double4::all(ray.origin[ray.z]);
  const Double4 shearX = Double4::all(ray.shearX), shearY = Double4::all(ray.shearY);
  Double4 x[3], y[3];
  for (int corner = 0; corner < 3; ++corner) {
    const Double4 z = Double4::load(block.corner[corner][ray.z]) - originZ;
    x[corner] = (Double4::load(block.corner[corner][ray.x]) - originX) - shearX * z;
    y[corner] = (Double4::load(block.corner[corner][ray.y]) - originY) - shearY * z;
  }
  const Double4 rounding = Double4::all(gammaError(4)), zero = Double4::all(0);
  unsigned left = 0xf, right = 0xf;  // lanes with no edge surely on the other side
  for (int corner = 0; corner < 3; ++corner) {
    const int p = corner, q = corner == 2 ? 0 : corner + 1;
    const Double4 a = x[p] * y[q], b = y[p] * x[q];
    const Double4 side = a - b, bound = (abs(a) + abs(b)) * rounding;
    left &= lessEqual(zero, side + bound);
    right &= lessEqual(side - bound, zero);
  }
  return left | right;
}

inline void queryMesh(const BvhNode* nodes, const TriangleBlock* blocks, const SlabRay& slab,
                      const LaneRay& ray, const double& tMost, bool nearestFirst, std::uint64_t& visited,
                      VisitLanes visit, void* context) {
  auto visitBlock = [&](std::uint32_t block) {
    const unsigned met = lanesMet(blocks[block], ray);
    return met != 0 && visit(context, block, met);
  };
  if (nearestFirst)
    traverse<true>(nodes, slab, tMost, visited, visitBlock);
  else
    traverse<false>(nodes, slab, tMost, visited, visitBlock);
}

}  // inline namespace
}  // namespace trace::simd
