// The way of a ray through a hierarchy. Included by the files that compile it for one instruction set each
// (bvh_kernel_*.cpp, geometry/mesh_kernel_*.cpp); calls no inline function from elsewhere, of which a linker
// could take that of one of them for all.
#pragma once

#include "accel/bvh_node.h"
#include "accel/simd.h"

namespace trace::simd {
namespace {  // each including file has its own, compiled with its own flags

/// A ray ready for the slab test, in float: x y z and a fourth lane that means nothing. One from far away
/// starts where it enters the hierarchy's extent, so that its float copy is as good as that of a near one; a
/// very long or short direction is scaled.
struct SlabRay {
  Float4 origin, direction, inverse;
  double start = 0, unit = 1;  ///< a distance s along this ray is the given ray's t = start + s / unit

  float fromT(double t) const {
    return static_cast<float>((t - start) * unit) * (1 + 0x1p-22f);
  }  // rounded up
};

/// Where the ray enters the extent, if it does before tMost; else a negative number.
inline double entry(const BvhExtent& extent, const double* origin, const double* direction, double tMost) {
  double enter = 0, leave = tMost;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / direction[axis];
    const double t0 = (extent.low[axis] - origin[axis]) * inverse,
                 t1 = (extent.high[axis] - origin[axis]) * inverse;
    const double first = inverse < 0 ? t1 : t0, last = inverse < 0 ? t0 : t1;
    // A NaN (0 * infinity: the ray lies in the plane of a face) leaves the interval as it is.
    if (first > enter) enter = first;
    if (last < leave) leave = last;
  }
  return enter <= leave ? enter : -1;
}

constexpr float kShortest = 1e-9f, kLongest = 1e9f;  // direction that need not be scaled

/// A ray from far away, or with an unusual direction; see prepare().
[[gnu::noinline]] bool prepareUnusual(const BvhExtent& extent, const double* origin, const double* direction,
                                      double tMost, SlabRay& ray) {
  double most = 0;
  bool near = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = __builtin_fabs(direction[axis]);
    if (size > most) most = size;
    near &= __builtin_fabs(origin[axis]) <= static_cast<double>(extent.reach);
  }
  if (!(most > 0)) return false;
  if (!near) ray.start = entry(extent, origin, direction, tMost);
  if (ray.start < 0) return false;
  const double scale = most < kShortest || most > kLongest ? __builtin_ldexp(1, -__builtin_ilogb(most)) : 1;
  ray.unit = 1 / scale;
  ray.origin = Float4::narrow(origin[0] + direction[0] * ray.start, origin[1] + direction[1] * ray.start,
                              origin[2] + direction[2] * ray.start);
  ray.direction = Float4::narrow(direction[0] * scale, direction[1] * scale, direction[2] * scale);
  return true;
}

/// False if the ray misses everything before tMost.
[[gnu::always_inline]] inline bool prepare(const BvhExtent& extent, const double* origin,
                                           const double* direction, double tMost, SlabRay& ray) {
  ray.origin = Float4::narrow(origin[0], origin[1], origin[2]);
  ray.direction = Float4::narrow(direction[0], direction[1], direction[2]);
  const unsigned near = lessEqual(abs(ray.origin), Float4::all(extent.reach)),
                 notLong = lessEqual(abs(ray.direction), Float4::all(kLongest)),
                 notShort = lessEqual(Float4::all(kShortest), abs(ray.direction));
  const bool usual = (near & notLong & 7) == 7 && (notShort & 7) != 0;
  if (!__builtin_expect(usual, 1)) {  // by way of copies, so that a usual ray stays in registers
    const double from[3] = {origin[0], origin[1], origin[2]},
                 along[3] = {direction[0], direction[1], direction[2]};
    SlabRay unusual;
    if (!prepareUnusual(extent, from, along, tMost, unusual)) return false;
    ray = unusual;
  }
  // No infinities in the slab test: a direction along an axis gets a very large inverse.
  ray.inverse = Float4::all(1) / withSign(max(abs(ray.direction), Float4::all(1e-18f)), ray.direction);
  return true;
}

/// The memory of a hierarchy. `leaves` is where the blocks of leaves are; null: elsewhere, or none.
struct Places {
  const BvhNode* nodes;
  const void* leaves = nullptr;
};

/// Asks the memory for lines of a child that the ray is about to visit, or will after others. Whether that is
/// a leaf is a mask and not a branch, which would be guessed wrongly.
template <unsigned kBegin = 0, unsigned kEnd = 4>
[[gnu::always_inline]] inline void fetch(const Places& places, std::uint32_t child) {
  const auto nodes = reinterpret_cast<std::uintptr_t>(places.nodes),
             leaves = reinterpret_cast<std::uintptr_t>(places.leaves);
  const auto leaf =
      static_cast<std::uintptr_t>(static_cast<std::intptr_t>(static_cast<std::int32_t>(child) >> 31));
  const std::uintptr_t at =
      (nodes ^ (leaf & (nodes ^ leaves))) + std::uintptr_t{child & ~BvhNode::kLeaf} * kPlaceBytes;
  for (unsigned line = kBegin; line < kEnd; ++line)  // an address may be of no memory
    __builtin_prefetch(reinterpret_cast<const char*>(at + 64 * line));
}

/// A child that waits for its turn, below where the ray enters its box: positive floats are ordered as their
/// bits are, so the nearer of two is the smaller number, and found without a branch that is guessed wrongly.
using Pending = std::uint64_t;
inline Pending pending(float near, std::uint32_t child) {
  return Pending{__builtin_bit_cast(std::uint32_t, near)} << 32 | child;
}

[[gnu::always_inline]] inline void tell(NodeCount& nodes, const BvhNode&) { ++nodes.count; }
[[gnu::always_inline]] inline void tell(NodeWatch& nodes, const BvhNode& node) {
  nodes.note(nodes.context, node, nodes.owner);
}

/// Calls visit(place of a leaf, limit), which returns true to end and may lower `limit`, for each leaf whose
/// box the ray may hit before it, in the branch of the node `next`. kNearestFirst: nearer boxes first, for
/// the closest hit; else those first that are fullest of items, which the builder has put into the lanes 0,
/// 7, 6, ... of a node.
template <bool kNearestFirst, class Nodes, class VisitLeaf>
[[gnu::always_inline]] inline void traverse(const Places& places, const SlabRay& ray, float limit,
                                            Nodes& visited, const VisitLeaf& visit, std::uint32_t next = 0) {
  Pending stack[8 * BvhNode::kMostDepth];  // seven waiting siblings for each level
  Pending* top = stack;

  // t of a plane at p: p inverse - shift
  const Float4 shifts = ray.origin * ray.inverse;
  const Float8 inverse[3] = {spread<0>(ray.inverse), spread<1>(ray.inverse), spread<2>(ray.inverse)};
  const Float8 shift[3] = {spread<0>(shifts), spread<1>(shifts), spread<2>(shifts)};
  // Where the planes that the ray hits first lie in a node, in floats. (The signs of the inverse are the
  // same, but a division later.)
  const unsigned backward = signs(ray.direction);
  const std::size_t side[3] = {backward << 3 & 8, 16 + (backward << 2 & 8), 32 + (backward << 1 & 8)};
  for (;;) {
    if (next & BvhNode::kLeaf) {
      if (visit(next & ~BvhNode::kLeaf, limit)) return;
    } else {
      const BvhNode& node = atPlace(places.nodes, next);
      tell(visited, node);
      const float* planes = &node.plane[0][0][0];
      Float8 first[3], last[3];
      for (int axis = 0; axis < 3; ++axis) {
        first[axis] = timesMinus(Float8::load(planes + side[axis]), inverse[axis], shift[axis]);
        last[axis] = timesMinus(Float8::load(planes + (side[axis] ^ 8)), inverse[axis], shift[axis]);
      }
      const Float8 enter = max(max(first[0], first[1]), max(first[2], Float8::all(0))),
                   leave = min(min(last[0], last[1]), min(last[2], Float8::all(limit)));
      unsigned met = lessEqual(enter, leave);
      if (met != 0) {
        const auto takeLane = [&] {
          const auto lane = static_cast<unsigned>(__builtin_ctz(met));
          met &= met - 1;
          return lane;
        };
        unsigned lane = takeLane();
        next = node.child[lane];
        if (met == 0) {  // visited at once, so that the processor asks for the other lines by itself
          fetch<3, 4>(places, next);
          continue;
        }
        fetch(places, next);
        if constexpr (kNearestFirst) {
          alignas(32) float near[8];
          enter.store(near);
          Pending nearest = pending(near[lane], next);
          const auto keepNearest = [&] {  // in hand; returns the other
            lane = takeLane();
            fetch(places, node.child[lane]);
            const Pending other = pending(near[lane], node.child[lane]),
                          further = other < nearest ? nearest : other;
            nearest = other < nearest ? other : nearest;
            return further;
          };
          const Pending* const bottom = top;
          *top++ = keepNearest();
          while (met != 0) {  // sorted, nearer ones on top
            const Pending further = keepNearest();
            Pending* place = top++;
            for (; place > bottom && place[-1] < further; --place) *place = place[-1];
            *place = further;
          }
          next = static_cast<std::uint32_t>(nearest);
        } else {
          do {
            const std::uint32_t child = node.child[takeLane()];
            fetch(places, child);
            *top++ = child;
          } while (met != 0);
        }
        continue;
      }
    }
    const Pending most = pending(limit, ~0u);
    do {
      if (top == stack) return;
      --top;
    } while (kNearestFirst && *top > most);
    next = static_cast<std::uint32_t>(*top);
  }
}

/// Does the work of a BvhKernel with the visitor as a function and its context.
template <class Nodes>
void queryLeaves(const BvhNode* nodes, const BvhExtent& extent, const Vec3& origin, const Vec3& direction,
                 const double& tMost, bool nearestFirst, Nodes& visited, bool (*visit)(void*, std::uint32_t),
                 void* context, std::uint32_t skip) {
  SlabRay ray;
  const double from[3] = {origin.x, origin.y, origin.z}, along[3] = {direction.x, direction.y, direction.z};
  if (!prepare(extent, from, along, tMost, ray)) return;
  const auto visitLeaf = [&](std::uint32_t leaf, float& limit) {
    if (leaf == skip) return false;
    const bool ended = visit(context, leaf);
    limit = ray.fromT(tMost);
    return ended;
  };
  const Places places{nodes};  // what the visitor looks at is its own affair
  if (nearestFirst)
    traverse<true>(places, ray, ray.fromT(tMost), visited, visitLeaf);
  else
    traverse<false>(places, ray, ray.fromT(tMost), visited, visitLeaf);
}

}  // namespace
}  // namespace trace::simd
