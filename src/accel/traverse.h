// The way of a ray through a hierarchy. Included by the files that compile it for one instruction set each
// (bvh_kernel_*.cpp, geometry/mesh_kernel_*.cpp); free of the standard library, whose functions a linker
// could take from one of them for all.
#pragma once

#include "accel/bvh_node.h"
#include "accel/simd.h"

namespace trace::simd {
namespace {  // each including file has its own, compiled with its own flags

/// Calls visit(leaf), which returns true to end, for each leaf whose box the ray may meet before tMost, which
/// may shrink during the calls, and visitNode(node) for each node. kNearestFirst: nearer boxes first, for the
/// closest hit; else in any order.
template <bool kNearestFirst, class VisitNode, class VisitLeaf>
void traverse(const BvhNode* nodes, const SlabRay& ray, const double& tMost, VisitNode& visitNode,
              VisitLeaf& visit) {
  struct Pending {
    std::uint32_t child;
    float near;  // where the ray enters its box
  };
  Pending stack[8 * BvhNode::kMostDepth];  // seven waiting siblings for each level
  int top = 0;

  Float8 inverse[3], shift[3];  // t of a plane at p: p inverse - shift
  std::size_t side[3];          // where the planes that the ray meets first lie in a node, in floats
  for (int axis = 0; axis < 3; ++axis) {
    inverse[axis] = Float8::all(ray.inverse[axis]);
    shift[axis] = Float8::all(ray.origin[axis] * ray.inverse[axis]);
    side[axis] = static_cast<std::size_t>(axis) * 16 + (ray.inverse[axis] < 0 ? 8 : 0);
  }
  constexpr float kRoundUp = 1 + 0x1p-22f;
  float limit = static_cast<float>(tMost - ray.start) * kRoundUp;

  Pending next{0, 0};
  for (;;) {
    if (next.child & BvhNode::kLeaf) {
      if (visit(next.child & ~BvhNode::kLeaf)) return;
      limit = static_cast<float>(tMost - ray.start) * kRoundUp;
    } else {
      const BvhNode& node = nodes[next.child];
      visitNode(node);
      const float* planes = &node.plane[0][0][0];
      Float8 enter = Float8::all(0), leave = Float8::all(limit);
      for (int axis = 0; axis < 3; ++axis) {
        enter = max(timesMinus(Float8::load(planes + side[axis]), inverse[axis], shift[axis]), enter);
        leave = min(timesMinus(Float8::load(planes + (side[axis] ^ 8)), inverse[axis], shift[axis]), leave);
      }
      unsigned met = lessEqual(enter, leave);
      if (met) {
        alignas(32) float near[8];
        enter.store(near);
        const auto take = [&] {
          const int lane = __builtin_ctz(met);
          met &= met - 1;
          return Pending{node.child[lane], near[lane]};
        };
        next = take();
        const int bottom = top;
        while (met) {
          Pending other = take();
          if constexpr (kNearestFirst) {  // keep the nearest in hand, the others sorted, nearest on top
            if (other.near < next.near) {
              const Pending nearer = other;
              other = next;
              next = nearer;
            }
            int place = top;
            for (; place > bottom && stack[place - 1].near < other.near; --place)
              stack[place] = stack[place - 1];
            stack[place] = other;
            ++top;
          } else {
            stack[top++] = other;
          }
        }
        continue;
      }
    }
    do {
      if (top == 0) return;
      next = stack[--top];
    } while (next.near > limit);
  }
}

/// The same with what is known at run time. Noting the nodes has a loop of its own, so that it costs the
/// others nothing.
template <class VisitLeaf>
void traverseCounting(const BvhNode* nodes, const SlabRay& ray, const double& tMost, bool nearestFirst,
                      NodeCount& visited, VisitLeaf& visit) {
  std::uint64_t& count = visited.count;
  auto add = [&count](const BvhNode&) { ++count; };
  auto note = [&visited](const BvhNode& node) {
    ++visited.count;
    visited.note(visited.context, node, visited.owner);
  };
  if (visited.note)
    nearestFirst ? traverse<true>(nodes, ray, tMost, note, visit)
                 : traverse<false>(nodes, ray, tMost, note, visit);
  else
    nearestFirst ? traverse<true>(nodes, ray, tMost, add, visit)
                 : traverse<false>(nodes, ray, tMost, add, visit);
}

/// The same with the visitor as a function and its context: what a BvhKernel does.
inline void queryLeaves(const BvhNode* nodes, const SlabRay& ray, const double& tMost, bool nearestFirst,
                        NodeCount& visited, bool (*visit)(void*, std::uint32_t), void* context) {
  auto visitLeaf = [=](std::uint32_t leaf) { return visit(context, leaf); };
  traverseCounting(nodes, ray, tMost, nearestFirst, visited, visitLeaf);
}

}  // namespace
}  // namespace trace::simd
