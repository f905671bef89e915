// A mesh as rays hit it: its triangles in the leaves of a hierarchy, four to a block.
//
// A block's four lanes are tested at once, in double; where a weight is so near zero that rounding might have
// given it the wrong sign, the exact test decides (triangle.h). So the hit is the one that testing every
// triangle finds.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "accel/bvh.h"
#include "geometry/mesh/mesh.h"

namespace trace {

/// Four triangles: their corners by corner, axis, lane, and their numbers, so that a hit reads no other
/// memory. Unused lanes hold NaN and are never hit. Aligned so that a block lies in three cache lines.
struct alignas(32) TriangleBlock {
  float corner[3][3][4];
  std::uint32_t triangle[4];

  Corners corners(std::size_t lane) const {
    const auto at = [&](int i) { return Vec3{corner[i][0][lane], corner[i][1][lane], corner[i][2][lane]}; };
    return {at(0), at(1), at(2)};
  }
};

static_assert(sizeof(TriangleBlock) == Bvh::kLeafPlaces * kPlaceBytes);

struct MeshHit {
  std::uint32_t triangle = Bvh::kNoItem;
  TriangleHit hit;
};

/// A mesh as the kernels see it.
struct MeshArrays {
  const BvhNode* nodes;
  const TriangleBlock* blocks;
  BvhExtent extent;
};

/// The query along a ray through a mesh.
struct MeshQuery {
  const Ray& ray;
  const MeshArrays& mesh;
  MeshHit& best;  ///< the nearest accepted so far; best.hit.t bounds what is sought
  /// Whether a hit counts; null: every hit does.
  bool (*accept)(void* context, const MeshHit&) = nullptr;
  void* context = nullptr;
  std::uint64_t blocks = 0;  ///< tested

  /// The exact test of a lane of a block.
  bool passes(const TriangleBlock& block, std::size_t lane) const;
};

/// The queries for the nearest hits along several rays; every hit counts.
struct MeshPacket {
  const Ray* const* rays;
  const MeshArrays& mesh;
  MeshHit* best;             ///< as in MeshQuery, for each ray
  unsigned lanes;            ///< bit i: there is a ray i
  std::uint64_t blocks = 0;  ///< tested, for each ray
};

/// The ways through a mesh; `Nodes`, NodeCount or NodeWatch, hears of the nodes.
template <class Nodes>
struct MeshWays {
  /// The nearest accepted hit at 0 < t <= best.hit.t; of several at the same t the first triangle.
  void (*closest)(MeshQuery&, Nodes&);
  /// Asks `accept` for every hit at 0 < t < best.hit.t, in any order, until it returns true.
  void (*crossings)(MeshQuery&, Nodes&);
};

/// They, compiled for one instruction set.
struct MeshKernel {
  std::string_view name;
  std::tuple<MeshWays<NodeCount>, MeshWays<NodeWatch>> ways;
  void (*closestTogether)(MeshPacket&, NodeCount&);
};

/// The kernels that this machine can run, the best first.
std::span<const MeshKernel> meshKernels();

/// Counted on the way.
template <class Nodes = NodeCount>
struct MeshCounts {
  Nodes& nodes;              ///< or watched
  std::uint64_t& triangles;  ///< tested, four at a time
};
template <class Nodes>
MeshCounts(Nodes&, std::uint64_t&) -> MeshCounts<Nodes>;

class MeshTree {
 public:
  /// Built by so many threads; 0 means all the hardware has.
  MeshTree(std::shared_ptr<const MeshData> data, bool bruteForce, int threads = 1,
           const MeshKernel& kernel = meshKernels().front());

  const MeshData& data() const { return *data_; }

  /// Whether there is a hit at 0 < t <= best.hit.t that accept(MeshHit) likes; `accept` may be nullptr, which
  /// likes all. Then `best` is the nearest, of several at the same t the triangle with the lowest number.
  template <class Accept, class Nodes>
  bool closest(const Ray& ray, MeshHit& best, Accept&& accept, MeshCounts<Nodes> counts) const;

  /// Asks for the rays of those lanes together, which all hits please: `best` becomes the nearest of
  /// each, or has no triangle. Fast where the rays go the same way.
  void closest(const Ray* const* rays, MeshHit* best, unsigned lanes, MeshCounts<> counts) const;

  /// Calls visit(MeshHit), which returns true to end the query, for every hit at 0 < t < tMost, in any order.
  /// A triangle that the hierarchy holds in parts may be hit more than once.
  template <class Visit, class Nodes>
  void crossings(const Ray& ray, Real tMost, Visit&& visit, MeshCounts<Nodes> counts) const;

  /// The memory of the structure for tracing, without the mesh's own arrays.
  std::size_t bytes() const { return bvh_.bytes() + blocks_.size() * sizeof(TriangleBlock); }

  MeshTree(const MeshTree&) = delete;
  MeshTree& operator=(const MeshTree&) = delete;

 private:
  /// Without a hierarchy: the scalar test for every triangle.
  template <class Visit>
  [[gnu::noinline]] void everyTriangle(const Ray& ray, const Real& tMost, const Visit& visit,
                                       std::uint64_t& tested) const;

  std::shared_ptr<const MeshData> data_;
  Bvh bvh_;
  HugeVector<TriangleBlock> blocks_;  ///< one for each leaf
  MeshArrays arrays_{};
  const MeshKernel& kernel_;
};

// ------------------------------------------------------------------------------------------------------

template <class Visit>
void MeshTree::everyTriangle(const Ray& ray, const Real& tMost, const Visit& visit,
                             std::uint64_t& tested) const {
  const TriangleRay triangleRay(ray);
  MeshHit met;
  for (std::uint32_t triangle : bvh_.items()) {
    ++tested;
    met.triangle = triangle;
    if (triangleRay.intersect(corners(*data_, triangle), tMost, met.hit) && visit(met)) return;
  }
}

template <class Accept, class Nodes>
bool MeshTree::closest(const Ray& ray, MeshHit& best, Accept&& accept, MeshCounts<Nodes> counts) const {
  constexpr bool kFiltered = !std::is_same_v<std::remove_cvref_t<Accept>, std::nullptr_t>;
  best.triangle = Bvh::kNoItem;
  if (bvh_.nodes().empty()) {
    everyTriangle(
        ray, best.hit.t,
        [&](const MeshHit& met) {
          const bool nearer =
              met.hit.t < best.hit.t || (met.hit.t == best.hit.t && met.triangle < best.triangle);
          if constexpr (kFiltered) {
            if (nearer && accept(met)) best = met;
          } else if (nearer) {
            best = met;
          }
          return false;
        },
        counts.triangles);
    return best.triangle != Bvh::kNoItem;
  }
  MeshQuery query{ray, arrays_, best};
  if constexpr (kFiltered) {
    query.context = const_cast<void*>(static_cast<const void*>(&accept));
    query.accept = [](void* context, const MeshHit& met) {
      return (*static_cast<std::remove_reference_t<Accept>*>(context))(met);
    };
  }
  std::get<MeshWays<Nodes>>(kernel_.ways).closest(query, counts.nodes);
  counts.triangles += query.blocks * Bvh::kLeafSize;
  return best.triangle != Bvh::kNoItem;
}

template <class Visit, class Nodes>
void MeshTree::crossings(const Ray& ray, Real tMost, Visit&& visit, MeshCounts<Nodes> counts) const {
  if (bvh_.nodes().empty()) {
    everyTriangle(
        ray, tMost, [&](const MeshHit& met) { return met.hit.t < tMost && visit(met); }, counts.triangles);
    return;
  }
  MeshHit met;
  met.hit.t = tMost;
  MeshQuery query{ray, arrays_, met};
  query.context = const_cast<void*>(static_cast<const void*>(&visit));
  query.accept = [](void* context, const MeshHit& hit) {
    return (*static_cast<std::remove_reference_t<Visit>*>(context))(hit);
  };
  std::get<MeshWays<Nodes>>(kernel_.ways).crossings(query, counts.nodes);
  counts.triangles += query.blocks * Bvh::kLeafSize;
}

}  // namespace trace
