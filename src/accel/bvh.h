// A bounding volume hierarchy over boxes: binary, built by the surface-area heuristic (Goldsmith and
// Salmon 1987; Wald 2007 for the bins). It knows boxes and item numbers only, so one structure serves the
// objects of a scene and the triangles of a mesh.
//
// The same boxes give the same tree, always. Boxes are stored in float, rounded outward and padded by 2^-22
// of their largest coordinate: more than a hit's rounding error at any but absurdly glancing angles, so
// that a query finds what testing every item would find.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/box.h"

namespace trace {

class Bvh {
 public:
  Bvh() = default;
  /// Over items 0 .. boxes.size() - 1. Empty boxes are never met.
  explicit Bvh(std::span<const Box3> boxes);

  /// No tree: every query visits every item whose box is not empty. What a hierarchy is tested against.
  static Bvh bruteForce(std::span<const Box3> boxes);

  /// Calls visit(item) for each item whose box the ray may meet at 0 <= t <= tMost, nearer subtrees first.
  /// `tMost` may shrink during the calls. Ends early when visit returns true. `nodes` counts boxes entered.
  template <class Visit>
  void query(const Vec3& origin, const Vec3& direction, const Real& tMost, std::uint64_t& nodes,
             Visit&& visit) const;

  std::size_t nodeCount() const { return nodes_.size(); }

 private:
  static constexpr int kMostDepth = 96;  // the builder halves by count below a depth that leaves room

  struct Node {
    float low[3], high[3];
    std::uint32_t first;  ///< inner: index of the left child, the right one follows; leaf: index into items_
    std::uint32_t count;  ///< 0 for inner nodes
  };

  struct Builder;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

// ------------------------------------------------------------------------------------------------------

template <class Visit>
void Bvh::query(const Vec3& origin, const Vec3& direction, const Real& tMost, std::uint64_t& nodes,
                Visit&& visit) const {
  if (nodes_.empty()) {
    for (std::uint32_t item : items_)
      if (visit(item)) return;
    return;
  }

  const Vec3 inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
  // Where the ray enters the box, or infinity if it misses. A NaN (0 * infinity, the ray in the plane of a
  // face) fails both comparisons and leaves the interval as it is.
  const auto enter = [&](const Node& node) {
    Real near = 0, far = tMost;
    for (int axis = 0; axis < 3; ++axis) {
      const bool backward = inverse[axis] < 0;
      const Real t0 = ((backward ? node.high[axis] : node.low[axis]) - origin[axis]) * inverse[axis];
      const Real t1 = ((backward ? node.low[axis] : node.high[axis]) - origin[axis]) * inverse[axis];
      near = t0 > near ? t0 : near;
      far = t1 < far ? t1 : far;
    }
    return near <= far ? near : kInfinity;
  };

  struct Pending {
    std::uint32_t node;
    Real near;
  };
  Pending stack[kMostDepth];
  int top = 0;
  if (const Real near = enter(nodes_[0]); near <= tMost && near < kInfinity) stack[top++] = {0, near};
  while (top > 0) {
    const Pending pending = stack[--top];
    if (pending.near > tMost) continue;
    const Node& node = nodes_[pending.node];
    ++nodes;
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (visit(items_[i])) return;
      continue;
    }
    Pending left{node.first, enter(nodes_[node.first])}, right{node.first + 1, enter(nodes_[node.first + 1])};
    if (left.near > right.near) std::swap(left, right);
    if (right.near < kInfinity) stack[top++] = right;
    if (left.near < kInfinity) stack[top++] = left;
  }
}

}  // namespace trace
