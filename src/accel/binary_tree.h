// The binary tree from which a hierarchy is made, built by the surface-area heuristic (Goldsmith and Salmon
// 1987; Wald 2007 for the bins).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/bounds.h"

namespace trace {

/// Not by its members: what was just written is read again as a whole.
inline void swap(BoxedItem& a, BoxedItem& b) {
  using simd::Float4;
  const Float4 low = Float4::load(a.low), high = Float4::load(a.high);
  Float4::load(b.low).store(a.low);
  Float4::load(b.high).store(a.high);
  low.store(b.low);
  high.store(b.high);
}

/// A node of the binary tree, with the box of all that hangs on it.
struct alignas(16) Branch {
  float low[3];
  std::uint32_t first;  ///< first of the left child, the right one follows; of a leaf: the first of its items
  float high[3];
  std::uint32_t count;  ///< count of a leaf's items; 0 for inner nodes
};
inline Bounds boxOf(const Branch& branch) {
  return {simd::Float4::loadThree(branch.low), simd::Float4::loadThree(branch.high)};
}

inline void set(Branch& branch, const Bounds& box, std::uint32_t first, std::uint32_t count) {
  box.low.store(branch.low);
  box.high.store(branch.high);
  branch.first = first;
  branch.count = count;
}

/// The cost of visiting a node, and a leaf, whose items are tested so many at a time.
inline constexpr float kCostOfNode = 0.5f, kCostOfLeaf = 1;
inline float leafCost(std::uint32_t count, std::uint32_t leafSize) {
  return kCostOfLeaf * static_cast<float>((count + leafSize - 1) / leafSize);
}

/// No item lies deeper.
inline constexpr int kMostDepthBuilt = 91;

/// The tree, its root first, parents before their children, over items that are put in the order of the
/// leaves; these hold up to leafSize of them. Their boxes are finite. The same for any number of threads; 0
/// means all the hardware has.
std::vector<Branch> binaryTree(std::span<BoxedItem> items, std::uint32_t leafSize, int threads);

}  // namespace trace
