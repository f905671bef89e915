// The way of eight rays through a hierarchy together, as the rays of neighbouring pixels go: what one of them
// fetches and decides serves all. Included by files that compile it for one instruction set, like traverse.h.
//
// A node's eight boxes are tested against the beam, that is, bounds of origins and directions (Boulos, Wald
// and Shirley, Geometric and arithmetic culling methods for entire ray packets, 2006). Each box that the beam
// may hit is then tested against the eight rays, lane by lane, as traverse() does for one ray. A ray that is
// alone in a branch continues without the others. So each ray visits every leaf whose box it hits before its
// limit.
#pragma once

#include "accel/traverse.h"

namespace trace::simd {
namespace {  // each including file has its own, compiled with its own flags

/// Rays whose directions have the same signs, lane by lane.
struct alignas(32) SlabPacket {
  static constexpr unsigned kRays = RayPacket::kRays;

  float inverse[3][kRays], shift[3][kRays];  ///< t of a plane at p: p inverse - shift
  float limit[kRays];                        ///< negative: the lane has no ray
  float beamInverse[2][3], beamShift[2][3];  ///< give the least t of a near plane, and the most of a far one
  unsigned backward;                         ///< signs of the directions, by axis
  unsigned lanes = 0;                        ///< those that have a ray

  /// Takes those of the `wanted` rays that have the signs of the first of them.
  SlabPacket(const SlabRay* rays, unsigned wanted) {
    const SlabRay& first = rays[__builtin_ctz(wanted)];
    backward = signs(first.direction) & 7;
    Float4 least = abs(first.inverse), most = least, low = first.origin, high = low;
    for (unsigned i = 0; i < kRays; ++i) {
      const bool fits = wanted >> i & 1 && (signs(rays[i].direction) & 7) == backward;
      lanes |= (fits ? 1u : 0u) << i;
      const SlabRay& ray = fits ? rays[i] : first;
      least = min(least, abs(ray.inverse));
      most = max(most, abs(ray.inverse));
      low = min(low, ray.origin);
      high = max(high, ray.origin);
      set(i, inverse, ray.inverse);
      set(i, shift, ray.origin * ray.inverse);
    }
    const Float4 nearest = withSign(least, first.direction), farthest = withSign(most, first.direction);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const bool back = backward >> axis & 1;
      beamInverse[0][axis] = at(nearest, axis);
      beamInverse[1][axis] = at(farthest, axis);
      beamShift[0][axis] = at(back ? low : high, axis) * beamInverse[0][axis];
      beamShift[1][axis] = at(back ? high : low, axis) * beamInverse[1][axis];
    }
  }

  float farthestLimit() const {
    float most = limit[0];
    for (unsigned i = 1; i < kRays; ++i) most = limit[i] > most ? limit[i] : most;
    return most;
  }

 private:
  static float at(Float4 values, unsigned axis) {
    alignas(16) float all[4];
    values.store(all);
    return all[axis];
  }
  static void set(unsigned lane, float (&columns)[3][kRays], Float4 values) {
    alignas(16) float all[4];
    values.store(all);
    for (int axis = 0; axis < 3; ++axis) columns[axis][lane] = all[axis];
  }
};

/// Where rays are in a box: from `enter` on, if that is at most `leave`.
struct Stretch {
  Float8 enter, leave;
};
[[gnu::always_inline]] inline Stretch between(const Float8 (&near)[3], const Float8 (&far)[3], Float8 limit) {
  return {max(max(near[0], near[1]), max(near[2], Float8::all(0))),
          min(min(far[0], far[1]), min(far[2], limit))};
}

/// Calls visit(place of a leaf, lanes), which lowers limits of the packet, for each leaf whose box some rays
/// may hit before their limits, and alone(place of a node, lane) for a branch that one ray continues in.
/// Nearer boxes first.
template <class Nodes, class VisitLeaf, class Alone>
[[gnu::always_inline]] inline void traverseTogether(const Places& places, const SlabPacket& packet,
                                                    Nodes& visited, const VisitLeaf& visit,
                                                    const Alone& alone) {
  struct Waiting {
    Pending child;
    unsigned lanes;
  };
  Waiting stack[8 * BvhNode::kMostDepth];  // seven waiting siblings for each level
  Waiting *top = stack, next{0, packet.lanes};

  std::size_t side[3];  // where the near planes lie in a node, in floats
  for (unsigned axis = 0; axis < 3; ++axis) side[axis] = 16 * axis + (packet.backward >> axis & 1) * 8;
  float limit = packet.farthestLimit();
  for (;;) {
    const auto place = static_cast<std::uint32_t>(next.child);
    if (place & BvhNode::kLeaf || (next.lanes & (next.lanes - 1)) == 0) {
      place& BvhNode::kLeaf ? visit(place & ~BvhNode::kLeaf, next.lanes)
                            : alone(place, static_cast<unsigned>(__builtin_ctz(next.lanes)));
      limit = packet.farthestLimit();
    } else {
      const BvhNode& node = atPlace(places.nodes, place);
      tell(visited, node);
      const float* planes = &node.plane[0][0][0];
      Float8 near[3], far[3];
      for (int axis = 0; axis < 3; ++axis) {
        near[axis] = timesMinus(Float8::load(planes + side[axis]), Float8::all(packet.beamInverse[0][axis]),
                                Float8::all(packet.beamShift[0][axis]));
        far[axis] =
            timesMinus(Float8::load(planes + (side[axis] ^ 8)), Float8::all(packet.beamInverse[1][axis]),
                       Float8::all(packet.beamShift[1][axis]));
      }
      const Stretch ofBeam = between(near, far, Float8::all(limit));
      alignas(32) float enters[8];
      ofBeam.enter.store(enters);
      const Waiting* const bottom = top;
      for (unsigned met = lessEqual(ofBeam.enter, ofBeam.leave); met != 0; met &= met - 1) {
        const auto child = static_cast<unsigned>(__builtin_ctz(met));
        for (int axis = 0; axis < 3; ++axis) {
          const Float8 inverse = Float8::load(packet.inverse[axis]), shift = Float8::load(packet.shift[axis]);
          near[axis] = timesMinus(Float8::all(planes[side[axis] + child]), inverse, shift);
          far[axis] = timesMinus(Float8::all(planes[(side[axis] ^ 8) + child]), inverse, shift);
        }
        const Stretch ofRays = between(near, far, Float8::load(packet.limit));
        const Waiting waiting{pending(enters[child], node.child[child]),
                              next.lanes & lessEqual(ofRays.enter, ofRays.leave)};
        if (waiting.lanes == 0) continue;
        fetch(places, node.child[child]);
        Waiting* at = top++;
        for (; at > bottom && at[-1].child < waiting.child; --at) *at = at[-1];  // nearer ones on top
        *at = waiting;
      }
    }
    const Pending most = pending(limit, ~0u);
    do {
      if (top == stack) return;
      next = *--top;
    } while (next.child > most);
  }
}

/// Calls visit(place of a leaf, lanes), which returns those whose tMost it has lowered, for each leaf whose
/// box some rays of the packet may hit before that; nearer boxes first.
template <class Visit>
[[gnu::always_inline]] inline void queryTogether(const Places& places, const BvhExtent& extent,
                                                 const RayPacket& rays, NodeCount& nodes,
                                                 const Visit& visit) {
  SlabRay slabs[RayPacket::kRays];
  unsigned together = 0, others = 0;
  for (unsigned lanes = rays.lanes; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(lanes));
    const Vec3 &from = *rays.origin[lane], &along = *rays.direction[lane];
    const double origin[3] = {from.x, from.y, from.z}, direction[3] = {along.x, along.y, along.z};
    SlabRay& slab = slabs[lane];
    if (!prepare(extent, origin, direction, *rays.tMost[lane], slab)) continue;
    (slab.start == 0 && slab.unit == 1 ? together : others) |= 1u << lane;
  }
  NodeCount visited = nodes;  // a copy of its own, which may stay in a register
  const auto limitOf = [&](unsigned lane) { return slabs[lane].fromT(*rays.tMost[lane]); };
  const auto alone = [&](std::uint32_t branch, unsigned lane) __attribute__((noinline)) {
    const auto visitOne = [&](std::uint32_t leaf, float& limit) {
      if (visit(leaf, 1u << lane) != 0) limit = limitOf(lane);
      return false;
    };
    traverse<true>(places, slabs[lane], limitOf(lane), visited, visitOne, branch);
  };
  if (together != 0) {
    SlabPacket packet(slabs, together);
    others |= together & ~packet.lanes;
    for (unsigned i = 0; i < RayPacket::kRays; ++i) packet.limit[i] = packet.lanes >> i & 1 ? limitOf(i) : -1;
    const auto visitSome = [&](std::uint32_t leaf, unsigned lanes) {
      for (unsigned lowered = visit(leaf, lanes); lowered != 0; lowered &= lowered - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(lowered));
        packet.limit[lane] = limitOf(lane);
      }
    };
    traverseTogether(places, packet, visited, visitSome, [&](std::uint32_t branch, unsigned lane) {
      alone(branch, lane);
      packet.limit[lane] = limitOf(lane);
    });
  }
  for (; others != 0; others &= others - 1) alone(0, static_cast<unsigned>(__builtin_ctz(others)));
  nodes = visited;
}

/// Does the work of a BvhKernel with the visitor as a function and its context.
inline void queryLeavesTogether(const BvhNode* nodes, const BvhExtent& extent, const RayPacket& rays,
                                NodeCount& visited, unsigned (*visit)(void*, std::uint32_t, unsigned),
                                void* context) {
  queryTogether({nodes}, extent, rays, visited,
                [&](std::uint32_t leaf, unsigned lanes) { return visit(context, leaf, lanes); });
}

}  // namespace
}  // namespace trace::simd
