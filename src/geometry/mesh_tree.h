// A mesh as rays meet it: its triangles in the leaves of a hierarchy, four to a block.
//
// The lanes of a block are tested in double, all four at once, and loosely: what rounding could decide
// passes. What passes, TriangleRay::intersect decides alone. So the hit is the one that testing every
// triangle finds.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "accel/bvh.h"
#include "geometry/mesh.h"

namespace trace {

/// The corners of four triangles: corner, axis, lane. Unused lanes hold NaN and are never met.
struct alignas(16) TriangleBlock {
  float corner[3][3][4];

  Corners corners(std::size_t lane) const {
    const auto at = [&](int i) { return Vec3{corner[i][0][lane], corner[i][1][lane], corner[i][2][lane]}; };
    return {at(0), at(1), at(2)};
  }
};

/// What the test of a block needs of a ray.
struct LaneRay {
  Real origin[3], direction[3];
  int x, y, z;
  Real shearX, shearY;
};

/// Meets `lanes` (bit i for lane i) of the block; returns true to end the query.
using VisitLanes = bool (*)(void* context, std::uint32_t block, unsigned lanes);

/// The way through a mesh, compiled for one instruction set.
struct MeshKernel {
  std::string_view name;
  void (*query)(const BvhNode* nodes, const TriangleBlock* blocks, const SlabRay& slab, const LaneRay& ray,
                const Real& tMost, bool nearestFirst, NodeCount& visited, VisitLanes visit, void* context);
};

/// Those that this machine can run, the best first.
std::span<const MeshKernel> meshKernels();

class MeshTree {
 public:
  MeshTree(std::shared_ptr<const MeshData> data, bool bruteForce);

  const MeshData& data() const { return *data_; }

  /// Calls visit(triangle, corners), which returns true to end the query, for each triangle that the ray may
  /// meet at 0 <= t <= tMost, which may shrink during the calls; nearer ones first if asked.
  template <class Visit>
  void query(const TriangleRay& ray, const Real& tMost, bool nearestFirst, NodeCount& visited, Visit&& visit,
             const MeshKernel& kernel = meshKernels().front()) const;

  /// Of the structure for tracing, without the mesh's own arrays.
  std::size_t bytes() const { return bvh_.bytes() + blocks_.size() * sizeof(TriangleBlock); }

 private:
  std::shared_ptr<const MeshData> data_;
  Bvh bvh_;
  HugeVector<TriangleBlock> blocks_;  ///< one for each leaf
};

// ------------------------------------------------------------------------------------------------------

template <class Visit>
void MeshTree::query(const TriangleRay& ray, const Real& tMost, bool nearestFirst, NodeCount& visited,
                     Visit&& visit, const MeshKernel& kernel) const {
  if (bvh_.nodes().empty()) {
    for (std::uint32_t number = 0; number < bvh_.leafCount(); ++number)
      for (std::uint32_t triangle : bvh_.leaf(number))
        if (triangle != Bvh::kNoItem && visit(triangle, corners(*data_, triangle))) return;
    return;
  }
  SlabRay slab;
  if (!bvh_.prepare(ray.origin, ray.direction, tMost, slab)) return;
  const LaneRay lanes{{ray.origin.x, ray.origin.y, ray.origin.z},
                      {ray.direction.x, ray.direction.y, ray.direction.z},
                      ray.x,
                      ray.y,
                      ray.z,
                      ray.shearX,
                      ray.shearY};
  const auto visitLanes = [&](std::uint32_t block, unsigned met) {
    for (; met != 0; met &= met - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(met));
      if (visit(bvh_.leaf(block)[lane], blocks_[block].corners(lane))) return true;
    }
    return false;
  };
  auto context = &visitLanes;
  kernel.query(
      bvh_.nodes().data(), blocks_.data(), slab, lanes, tMost, nearestFirst, visited,
      [](void* c, std::uint32_t block, unsigned met) {
        return (**static_cast<decltype(context)*>(c))(block, met);
      },
      &context);
}

}  // namespace trace
