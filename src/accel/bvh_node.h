// The contents of a hierarchy's nodes and the ray data of a query: plain data, shared by the code for all
// instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trace {

/// Eight children: their boxes, lane by lane, and what they are.
struct alignas(32) BvhNode {
  static constexpr int kMostDepth = 160;               ///< most depth of any tree
  static constexpr std::uint32_t kLeaf = 0x80000000u;  ///< set for leaves; the other bits number the leaf

  float plane[3][2][8];    ///< axis, low or high, lane; an empty lane has low > high
  std::uint32_t child[8];  ///< a leaf, or the place of a node
};

/// A node's place is its distance from the root in units of 32 bytes: no multiplication on a ray's way.
inline constexpr std::uint32_t kNodePlaces = sizeof(BvhNode) / 32;
inline const BvhNode& nodeAt(const BvhNode* nodes, std::uint32_t place) {
  return *reinterpret_cast<const BvhNode*>(reinterpret_cast<const char*>(nodes) + std::size_t{place} * 32);
}

/// How many nodes queries have visited.
struct NodeCount {
  std::uint64_t count = 0;
  bool operator==(const NodeCount&) const = default;
};

/// Takes the place of a NodeCount where someone wants to see the nodes: hears of each, in their order. A
/// query is compiled once for either, so that the usual one knows nothing of this.
struct NodeWatch {
  static constexpr std::uint32_t kTop = 0xffffffffu;

  void (*note)(void* context, const BvhNode& node, std::uint32_t owner) = nullptr;
  void* context = nullptr;
  std::uint32_t owner = kTop;  ///< whose hierarchy is queried, as the caller numbers them
  /// Within a placement of a group: its number, and what is added to those of its objects.
  std::uint32_t placement = kTop, shift = 0;
};

/// The whole of a hierarchy.
struct BvhExtent {
  double low[3], high[3];  ///< low and high of all boxes
  float reach;             ///< coordinates up to this are precise enough in float
};

}  // namespace trace
