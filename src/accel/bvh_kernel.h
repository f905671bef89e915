// A ray's way through a hierarchy, compiled once for each instruction set and chosen for the processor at run
// time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>

#include "accel/bvh_node.h"
#include "math/vec.h"

namespace trace {

/// Is called with the number of a leaf; returns true to end the query.
using VisitLeaf = bool (*)(void* context, std::uint32_t leaf);

/// The leaf of the number `skip` is not visited. `Nodes` is NodeCount or NodeWatch.
template <class Nodes>
using BvhQuery = void (*)(const BvhNode* nodes, const BvhExtent& extent, const Vec3& origin,
                          const Vec3& direction, const double& tMost, bool nearestFirst, Nodes& visited,
                          VisitLeaf visit, void* context, std::uint32_t skip);

/// Is called with the number of a leaf and the lanes of rays; returns those whose tMost it has lowered.
using VisitTogether = unsigned (*)(void* context, std::uint32_t leaf, unsigned lanes);
using BvhQueryTogether = void (*)(const BvhNode* nodes, const BvhExtent& extent, const RayPacket& rays,
                                  NodeCount& visited, VisitTogether visit, void* context);

struct BvhKernel {
  std::string_view name;
  std::tuple<BvhQuery<NodeCount>, BvhQuery<NodeWatch>> queries;
  BvhQueryTogether together;  ///< nearest first
};

/// Whether this machine runs what is compiled for AVX2 (and fused multiply-add).
bool hasAvx2();
/// The kernel for AVX-512 with its 256-bit forms.
bool hasAvx512();

/// The kernels that this machine can run, the best first.
std::span<const BvhKernel> bvhKernels();

}  // namespace trace
