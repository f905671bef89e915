// The contents of a hierarchy's nodes and the ray data of a query: plain data, shared by the code for all
// instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/vec.h"

namespace trace {

/// Eight children: their boxes, lane by lane, and what they are, which lies beside planes and
/// comes with them from the memory.
struct alignas(32) BvhNode {
  static constexpr int kMostDepth = 160;               ///< most depth of any tree
  static constexpr std::uint32_t kLeaf = 0x80000000u;  ///< set for leaves; the other bits are its place

  std::uint32_t child[8];  ///< the place of a node or, with kLeaf, of a leaf
  float plane[3][2][8];    ///< axis, low or high, lane; an empty lane has low > high
};

/// The place of a node, or of a block of items that are tested together, is its distance from the first in
/// units of 32 bytes: no multiplication on a ray's way. The place of a leaf with a single item is the item's
/// number.
inline constexpr std::uint32_t kPlaceBytes = 32;
inline constexpr std::uint32_t kNodePlaces = sizeof(BvhNode) / kPlaceBytes;
template <class T>
const T& atPlace(const T* first, std::uint32_t place) {
  return *reinterpret_cast<const T*>(reinterpret_cast<const char*>(first) + std::size_t{place} * kPlaceBytes);
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

/// Rays that go through a hierarchy together, wherever they lie.
struct RayPacket {
  static constexpr unsigned kRays = 8;

  const Vec3* origin[kRays];
  const Vec3* direction[kRays];
  const double* tMost[kRays];
  unsigned lanes = 0;  ///< bit i: there is a ray i
};

/// The whole of a hierarchy.
struct BvhExtent {
  double low[3], high[3];  ///< low and high of all boxes
  float reach;             ///< coordinates up to this are precise enough in float
};

}  // namespace trace
