#include "geometry/mesh/mesh_tree.h"

#include <algorithm>
#include <array>
#include <limits>

#include "accel/simd.h"
#include "geometry/mesh/presplit.h"

namespace trace {

// Compiled from mesh_kernel.h, each in its own file with its own flags.
#if defined(TRACE_HAS_AVX2)
extern const MeshKernel kMeshKernelAvx512;
extern const MeshKernel kMeshKernelAvx2;
#endif
extern const MeshKernel kMeshKernelBase;

std::span<const MeshKernel> meshKernels() {
#if defined(TRACE_HAS_AVX2)
  static const std::array<MeshKernel, 3> kAll{kMeshKernelAvx512, kMeshKernelAvx2, kMeshKernelBase};
  return std::span(kAll).subspan(hasAvx512() ? 0 : hasAvx2() ? 1 : 2);
#else
  return {&kMeshKernelBase, 1};
#endif
}

bool MeshQuery::passes(const TriangleBlock& block, std::size_t lane) const {
  return TriangleRay(ray).passes(block.corners(lane));
}

namespace {

void fill(TriangleBlock& block, const MeshData& mesh,
          std::span<const std::uint32_t, Bvh::kLeafSize> triangles) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  constexpr Vec3f kNowhere{kNone, kNone, kNone};
  std::copy(triangles.begin(), triangles.end(), block.triangle);
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto point = [&](std::size_t lane) {
      const std::uint32_t triangle = triangles[lane];
      const Vec3f& p = triangle == Bvh::kNoItem ? kNowhere : mesh.points[mesh.triangles[triangle][corner]];
      return simd::Float4::of(p.x, p.y, p.z);
    };
    simd::Float4 axes[3];
    transpose(point(0), point(1), point(2), point(3), axes);
    for (int axis = 0; axis < 3; ++axis) axes[axis].store(block.corner[corner][axis]);
  }
}

}  // namespace

MeshTree::MeshTree(std::shared_ptr<const MeshData> data, bool bruteForce, int threads,
                   const MeshKernel& kernel)
    : data_(std::move(data)), kernel_(kernel) {
  std::vector<BoxedItem> parts = triangleParts(*data_, bruteForce);
  bvh_ = bruteForce ? Bvh::bruteForce(parts) : Bvh(std::move(parts), Bvh::Leaves::together, threads);

  if (bvh_.nodes().empty()) return;
  blocks_.reserve(bvh_.leafCount());
  for (std::uint32_t leaf = 0; leaf < bvh_.leafCount(); ++leaf)
    fill(blocks_.emplace_back(), *data_, bvh_.leaf(leaf));
  arrays_ = {bvh_.nodes().data(), blocks_.data(), bvh_.extent()};
  bvh_.forgetItems();  // the blocks know them
}

void MeshTree::closest(const Ray* const* rays, MeshHit* best, unsigned lanes, MeshCounts<> counts) const {
  for (unsigned lane = 0; lane < RayPacket::kRays; ++lane) {
    if (!(lanes >> lane & 1)) continue;
    best[lane].triangle = Bvh::kNoItem;
    if (bvh_.nodes().empty()) closest(*rays[lane], best[lane], nullptr, counts);
  }
  if (bvh_.nodes().empty()) return;
  MeshPacket packet{rays, arrays_, best, lanes};
  kernel_.closestTogether(packet, counts.nodes);
  counts.triangles += packet.blocks * Bvh::kLeafSize;
}

}  // namespace trace
