#include "geometry/mesh_tree.h"

#include <array>
#include <limits>

#include "geometry/presplit.h"

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

bool MeshQuery::passes(std::uint32_t block, std::size_t lane) const {
  return TriangleRay(ray).passes(mesh.blocks[block].corners(lane));
}

MeshTree::MeshTree(std::shared_ptr<const MeshData> data, bool bruteForce, int threads,
                   const MeshKernel& kernel)
    : data_(std::move(data)), kernel_(kernel) {
  {
    const TriangleParts parts = triangleParts(*data_, bruteForce);
    bvh_ = bruteForce ? Bvh::bruteForce(parts.boxes) : Bvh(parts.boxes, Bvh::Leaves::together, threads);
    bvh_.rename(parts.triangles);
  }

  blocks_.resize(bvh_.nodes().empty() ? 0 : bvh_.leafCount());
  for (std::uint32_t block = 0; block < blocks_.size(); ++block)
    for (std::size_t lane = 0; lane < Bvh::kLeafSize; ++lane) {
      const std::uint32_t triangle = bvh_.leaf(block)[lane];
      for (std::size_t corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis)
          blocks_[block].corner[corner][axis][lane] =
              triangle == Bvh::kNoItem ? std::numeric_limits<float>::quiet_NaN()
                                       : data_->points[data_->triangles[triangle][corner]][axis];
    }
  if (blocks_.empty()) return;
  arrays_ = {bvh_.nodes().data(), blocks_.data(), bvh_.leaf(0).data(), bvh_.extent()};
}

}  // namespace trace
