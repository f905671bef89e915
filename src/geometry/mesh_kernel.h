// The test of four triangles at once, and a ray's way through the blocks of a mesh. Compiled once for each
// instruction set (mesh_kernel_*.cpp), like accel/traverse.h.
#pragma once

#include "accel/traverse.h"
#include "geometry/mesh_tree.h"

namespace trace::simd {
namespace {  // each including file has its own, compiled with its own flags

struct Vec3x4 {
  Double4 x, y, z;
};
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double4 dot(const Vec3x4& a, const Vec3x4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Of the lanes in `met`, those whose t is in [0, tMost] or undefined. The same arithmetic, to the last bit,
/// as in TriangleRay::intersect.
inline unsigned lanesWithin(const TriangleBlock& block, const LaneRay& ray, double tMost, unsigned met) {
  const auto corner = [&](int i) {
    return Vec3x4{Double4::load(block.corner[i][0]), Double4::load(block.corner[i][1]),
                  Double4::load(block.corner[i][2])};
  };
  const auto all = [](const double* v) {
    return Vec3x4{Double4::all(v[0]), Double4::all(v[1]), Double4::all(v[2])};
  };
  const Vec3x4 a = corner(0), normal = cross(corner(1) - a, corner(2) - a);
  const Double4 along = dot(normal, all(ray.direction)), zero = Double4::all(0);
  const Double4 t = dot(normal, a - all(ray.origin)) / along;
  return met & (lessEqual(abs(along), zero) | (lessEqual(zero, t) & lessEqual(t, Double4::all(tMost))));
}

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
  constexpr double kRounding = gammaError(4);
  const Double4 rounding = Double4::all(kRounding), zero = Double4::all(0);
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
                      const LaneRay& ray, const double& tMost, bool nearestFirst, NodeCount& visited,
                      VisitLanes visit, void* context) {
  auto visitBlock = [&](std::uint32_t block) {
    unsigned met = lanesMet(blocks[block], ray);
    if (met != 0) met = lanesWithin(blocks[block], ray, tMost, met);
    return met != 0 && visit(context, block, met);
  };
  traverseCounting(nodes, slab, tMost, nearestFirst, visited, visitBlock);
}

}  // namespace
}  // namespace trace::simd
