// Counts of a render. Each worker counts for itself; the sums are the same for any number of threads.
#pragma once

#include <array>
#include <cstdint>

#include "accel/bvh_node.h"
#include "geometry/shape.h"
#include "render/world/move_kind.h"
#include "render/world/ray_kind.h"

namespace trace {

/// Counts of queries. `Nodes`: NodeCount, or NodeWatch for those who observe the nodes
/// (render/rays/visited_boxes.h).
template <class Nodes>
struct QueryCounts {
  static constexpr std::size_t kShapes = kMostShapeTypes;

  std::array<std::uint64_t, kShapes> tests{}, hits{};  ///< per shape, in the order of shapeTypes()
  Nodes nodes{};                                       ///< nodes of hierarchies, visited
  bool operator==(const QueryCounts&) const = default;
};

struct Statistics : QueryCounts<NodeCount> {
  std::array<std::uint64_t, kRayKinds> rays{};  ///< by RayKind
  std::uint64_t depths = 0;      ///< sum of the depths of all but shadow rays: a camera ray has depth 0
  std::uint64_t badSamples = 0;  ///< NaN or infinite, dropped
  std::array<std::uint64_t, kMoveKinds> moves{}, movesKept{};  ///< by MoveKind
  /// The light that --firefly-limit removed from samples: a sum of luminances in parts of kLightParts, which
  /// no order changes.
  std::uint64_t lightRemoved = 0;
  static constexpr double kLightParts = 1 << 20;

  std::uint64_t allRays() const {
    std::uint64_t sum = 0;
    for (std::uint64_t n : rays) sum += n;
    return sum;
  }
  void count(MoveKind kind, bool kept) {
    ++moves[static_cast<std::size_t>(kind)];
    movesKept[static_cast<std::size_t>(kind)] += kept;
  }
  bool hasMoves() const { return moves != decltype(moves){}; }
  /// All but shadow rays.
  std::uint64_t pathRays() const { return allRays() - rays[static_cast<std::size_t>(RayKind::shadow)]; }
  Statistics& operator+=(const Statistics& other) {
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i] += other.rays[i];
    for (std::size_t i = 0; i < kShapes; ++i) {
      tests[i] += other.tests[i];
      hits[i] += other.hits[i];
    }
    depths += other.depths;
    nodes.count += other.nodes.count;
    badSamples += other.badSamples;
    lightRemoved += other.lightRemoved;
    for (std::size_t i = 0; i < kMoveKinds; ++i) {
      moves[i] += other.moves[i];
      movesKept[i] += other.movesKept[i];
    }
    return *this;
  }
  bool operator==(const Statistics&) const = default;
};

}  // namespace trace
