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

/// The corners of four triangles: corner, axis, lane. Unused lanes are degenerate and never met.
struct alignas(16) TriangleBlock {
  float corner[3][3][4];
};

/// What the test of a block needs of a ray.
struct LaneRay {
  Real origin[3];
  int x, y, z;
  Real shearX, shearY;
};

/// Meets `lanes` (bit i for lane i) of the block; returns true to end the query.
using VisitLanes = bool (*)(void* context, std::uint32_t block, unsigned lanes);

/// The way through a mesh, compiled for one instruction set.
struct MeshKernel {
  std::string_view name;
  void (*query)(const BvhNode* nodes, const TriangleBlock* blocks, const SlabRay& slab, const LaneRay& ray,
                const Real& tMost, bool nearestFirst, std::uint64_t& visited, VisitLanes visit,
                void* context);
};

/// Those that this machine can run, the best first.
std::span<const MeshKernel> meshKernels();

class MeshTree {
 public:
  MeshTree(std::shared_ptr<const MeshData> data, bool bruteForce);

  const MeshData& data() const { return *data_; }

  /// Calls visit(triangle), which returns true to end the query, for each triangle that the ray may meet at
  /// 0 <= t <= tMost, which may shrink during the calls; nearer ones first if asked.
  template <class Visit>
  void query(const Ray& ray, const Real& tMost, bool nearestFirst, std::uint64_t& visited, Visit&& visit,
             const MeshKernel& kernel = meshKernels().front()) const;

  /// Of the structure for tracing, without the mesh's own arrays.
  std::size_t bytes() const { return bvh_.bytes() + blocks_.size() * sizeof(TriangleBlock); }

 private:
  std::shared_ptr<const MeshData> data_;
  Bvh bvh_;
  std::vector<TriangleBlock> blocks_;  ///< one for each leaf
};

// ------------------------------------------------------------------------------------------------------

template <class Visit>
void MeshTree::query(const Ray& ray, const Real& tMost, bool nearestFirst, std::uint64_t& visited,
                     Visit&& visit, const MeshKernel& kernel) const {
  const auto visitLanes = [&](std::uint32_t block, unsigned lanes) {
    const auto items = bvh_.leaf(block);
    for (std::size_t lane = 0; lane < items.size(); ++lane)
      if (lanes >> lane & 1 && items[lane] != Bvh::kNoItem && visit(items[lane])) return true;
    return false;
  };
  if (bvh_.nodes().empty()) {
    for (std::uint32_t block = 0; block < bvh_.leafCount(); ++block)
      if (visitLanes(block, 0xf)) return;
    return;
  }
  SlabRay slab;
  if (!bvh_.prepare(ray.origin, ray.direction, tMost, slab)) return;
  const TriangleRay t(ray);
  const LaneRay lanes{{t.origin.x, t.origin.y, t.origin.z}, t.x, t.y, t.z, t.shearX, t.shearY};
  auto context = &visitLanes;
  kernel.query(
      bvh_.nodes().data(), blocks_.data(), slab, lanes, tMost, nearestFirst, visited,
      [](void* c, std::uint32_t block, unsigned met) {
        return (**static_cast<decltype(context)*>(c))(block, met);
      },
      &context);
}

}  // namespace trace
