// A bounding volume hierarchy over boxes, eight to a node (Wald, Benthin and Boulos 2008), collapsed from a
// binary tree built by the surface-area heuristic (Goldsmith and Salmon 1987; Wald 2007 for the bins). It
// knows boxes and item numbers only, so one structure serves the objects of a scene and the triangles of a
// mesh.
//
// The same boxes give the same tree, for any number of threads. Boxes are float, and padded by far more than
// a query's rounding: a query finds what testing every item would find.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/boxed_item.h"
#include "accel/bvh_kernel.h"
#include "accel/bvh_node.h"
#include "base/huge_pages.h"
#include "math/box.h"

namespace trace {

class Bvh {
 public:
  static constexpr int kLeafSize = 4;
  static constexpr std::uint32_t kNoItem = 0xffffffffu;

  /// How many items a leaf may hold: one, where each costs a test of its own; kLeafSize where they are tested
  /// together, as blocks of kLeafPlaces (bvh_node.h).
  enum class Leaves { single, together };
  static constexpr std::uint32_t kLeafPlaces = 5;

  Bvh() = default;
  /// Over items 0 .. boxes.size() - 1. Empty boxes are left out. The tree is the same for any number of
  /// threads; 0 means all the hardware has.
  explicit Bvh(std::span<const Box3> boxes, Leaves leaves = Leaves::single, int threads = 1);

  /// Over these, whose boxes are not empty.
  Bvh(std::vector<BoxedItem> items, Leaves leaves, int threads);

  /// No tree: every query visits every item whose box is not empty. What a hierarchy is tested against.
  static Bvh bruteForce(std::span<const Box3> boxes);
  static Bvh bruteForce(std::span<const BoxedItem> items);

  /// Calls visit(item), which returns true to end the query, for each item whose box the ray may hit at
  /// 0 <= t <= tMost, nearer boxes first if asked. `tMost` may shrink during the calls. `nodes`, a NodeCount
  /// or a NodeWatch, hears of the nodes visited. For trees with single items only; items that are tested
  /// together have a way of their own (geometry/mesh/mesh_kernel.h). The item `skip` is left out.
  template <class Nodes, class Visit>
  void query(const Vec3& origin, const Vec3& direction, const Real& tMost, bool nearestFirst, Nodes& nodes,
             Visit&& visit, std::uint32_t skip = kNoItem) const;

  /// Asks for several rays, nearer boxes first: calls visit(item, lanes), which returns the lanes whose
  /// tMost it has lowered. Fast where the rays go the same way.
  template <class Visit>
  void query(const RayPacket& rays, NodeCount& nodes, Visit&& visit) const;

  /// The best for the machine if not set.
  void setKernel(const BvhKernel& kernel) { kernel_ = &kernel; }

  /// All items, in leaves one after the other; without a tree simply all.
  std::span<const std::uint32_t> items() const { return items_; }
  /// Where items are together: those of a leaf, then kNoItem in the places left over.
  std::span<const std::uint32_t, kLeafSize> leaf(std::uint32_t number) const {
    return std::span<const std::uint32_t, kLeafSize>(items_.data() + std::size_t{number} * kLeafSize,
                                                     kLeafSize);
  }
  /// Frees the memory of items(), for an owner who keeps the leaves' items elsewhere and never asks again.
  void forgetItems() { items_ = {}; }
  std::uint32_t leafCount() const { return static_cast<std::uint32_t>(items_.size() / kLeafSize); }
  const HugeVector<BvhNode>& nodes() const { return nodes_; }
  std::size_t bytes() const {
    return nodes_.size() * sizeof(BvhNode) + items_.size() * sizeof(std::uint32_t);
  }

  const BvhExtent& extent() const { return extent_; }

 private:
  struct Builder;

  void build(std::vector<BoxedItem> items, const Box3& whole, Leaves leaves, int threads);

  BvhExtent extent_{};
  const BvhKernel* kernel_ = &bvhKernels().front();
  HugeVector<BvhNode> nodes_;         ///< nodes_[0] is the root; none: brute force
  std::vector<std::uint32_t> items_;  ///< kLeafSize for each leaf, or one; brute force: all
};

// ------------------------------------------------------------------------------------------------------

template <class Nodes, class Visit>
void Bvh::query(const Vec3& origin, const Vec3& direction, const Real& tMost, bool nearestFirst, Nodes& nodes,
                Visit&& visit, std::uint32_t skip) const {
  if (nodes_.empty()) {
    for (std::uint32_t item : items_)
      if (item != skip && visit(item)) return;
    return;
  }
  using V = std::remove_reference_t<Visit>;
  std::get<BvhQuery<Nodes>>(kernel_->queries)(
      nodes_.data(), extent_, origin, direction, tMost, nearestFirst, nodes,
      [](void* context, std::uint32_t item) { return (*static_cast<V*>(context))(item); },
      const_cast<void*>(static_cast<const void*>(&visit)), skip);
}

template <class Visit>
void Bvh::query(const RayPacket& rays, NodeCount& nodes, Visit&& visit) const {
  if (nodes_.empty()) {
    for (std::uint32_t item : items_) visit(item, rays.lanes);
    return;
  }
  using V = std::remove_reference_t<Visit>;
  kernel_->together(
      nodes_.data(), extent_, rays, nodes,
      [](void* context, std::uint32_t item, unsigned lanes) {
        return (*static_cast<V*>(context))(item, lanes);
      },
      const_cast<void*>(static_cast<const void*>(&visit)));
}

}  // namespace trace
