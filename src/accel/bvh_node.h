// What a hierarchy's nodes hold and what a query needs of a ray: plain data, shared by the code for all
// instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trace {

/// Eight children: their boxes, lane by lane, and what they are.
struct alignas(32) BvhNode {
  static constexpr int kMostDepth = 96;                ///< of any tree
  static constexpr std::uint32_t kLeaf = 0x80000000u;  ///< set for leaves; the other bits number the leaf

  float plane[3][2][8];  ///< axis, low or high, lane; an empty lane has low > high
  std::uint32_t child[8];
};

/// How many nodes queries have visited; `note`, if set, hears of each.
struct NodeCount {
  static constexpr std::uint32_t kTop = 0xffffffffu;

  std::uint64_t count = 0;
  std::uint32_t owner = kTop;  ///< whose hierarchy is queried, as the caller numbers them; for note
  void (*note)(void* context, const BvhNode& node, std::uint32_t owner) = nullptr;
  void* context = nullptr;

  bool operator==(const NodeCount& other) const { return count == other.count; }
};

/// A ray ready for the slab test. One from far away starts where it enters the hierarchy's whole box, so that
/// its float copy is as good as that of a near one.
struct SlabRay {
  float origin[3], inverse[3];
  double start = 0;  ///< t of the ray at `origin`
};

}  // namespace trace
