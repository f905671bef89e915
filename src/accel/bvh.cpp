#include "accel/bvh.h"

#include <algorithm>
#include <array>
#include <limits>

namespace trace {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kMostInLeaf = 4;
constexpr int kDepthOfHeuristic = 60;  // deeper, nodes are halved by count: 32 more levels hold 2^32 items
constexpr Real kCostOfStep = 1;        // of visiting a node, in tests of one item

float roundDown(Real x) {
  const float f = static_cast<float>(x);
  return static_cast<Real>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float roundUp(Real x) { return -roundDown(-x); }

struct Bin {
  Box3 box;
  std::uint32_t count = 0;
};

}  // namespace

struct Bvh::Builder {
  std::span<const Box3> boxes;
  std::vector<Vec3> centers;
  std::vector<Node>& nodes;
  std::vector<std::uint32_t>& items;

  struct Split {
    Real cost = kInfinity;
    int axis = 0, bin = 0;
  };

  int binOf(const Box3& centroids, int axis, std::uint32_t item) const {
    const Real scale = kBins / (centroids.high[axis] - centroids.low[axis]);
    const Real bin = (centers[item][axis] - centroids.low[axis]) * scale;
    return std::clamp(static_cast<int>(std::min(bin, Real{kBins})), 0, kBins - 1);
  }

  /// The cheapest of the planes between bins: sum of half-area times count on both sides.
  Split cheapestSplit(std::uint32_t first, std::uint32_t count, const Box3& centroids) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const Real extent = centroids.high[axis] - centroids.low[axis];
      if (!(extent > 0) || !std::isfinite(kBins / extent)) continue;
      std::array<Bin, kBins> bins;
      for (std::uint32_t i = first; i < first + count; ++i) {
        Bin& bin = bins[static_cast<size_t>(binOf(centroids, axis, items[i]))];
        bin.box.extend(boxes[items[i]]), ++bin.count;
      }
      std::array<Real, kBins> rightCost{};
      Bin right, left;
      for (size_t b = kBins - 1; b > 0; --b) {
        right.box.extend(bins[b].box), right.count += bins[b].count;
        rightCost[b] = right.count ? halfArea(right.box) * right.count : 0;
      }
      for (size_t b = 0; b + 1 < kBins; ++b) {
        left.box.extend(bins[b].box), left.count += bins[b].count;
        if (left.count == 0 || left.count == count) continue;
        const Real cost = halfArea(left.box) * left.count + rightCost[b + 1];
        if (cost < best.cost) best = {cost, axis, static_cast<int>(b)};
      }
    }
    return best;
  }

  void setBounds(Node& node, const Box3& box) const {
    const Real pad = std::max(maxComponent(abs(box.low)), maxComponent(abs(box.high))) / (1 << 22);
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis] = roundDown(box.low[axis] - pad);
      node.high[axis] = roundUp(box.high[axis] + pad);
    }
  }

  void build(std::uint32_t index, std::uint32_t first, std::uint32_t count, int depth) {
    Box3 box, centroids;
    for (std::uint32_t i = first; i < first + count; ++i)
      box.extend(boxes[items[i]]), centroids.extend(centers[items[i]]);
    setBounds(nodes[index], box);

    const Split split = depth < kDepthOfHeuristic ? cheapestSplit(first, count, centroids) : Split{};
    const Real asLeaf = halfArea(box) * count, asNode = halfArea(box) * kCostOfStep + split.cost;
    if (count == 1 || (count <= kMostInLeaf && !(asNode < asLeaf))) {
      nodes[index].first = first, nodes[index].count = count;
      return;
    }
    const auto begin = items.begin() + first, end = begin + count;
    auto middle = begin + count / 2;  // items that no plane separates are halved by number
    if (split.cost < kInfinity)
      middle = std::stable_partition(begin, end, [&](std::uint32_t item) {
        return binOf(centroids, split.axis, item) <= split.bin;
      });
    const auto leftCount = static_cast<std::uint32_t>(middle - begin);
    const auto children = static_cast<std::uint32_t>(nodes.size());
    nodes[index].first = children, nodes[index].count = 0;
    nodes.resize(nodes.size() + 2);
    build(children, first, leftCount, depth + 1);
    build(children + 1, first + leftCount, count - leftCount, depth + 1);
  }
};

Bvh Bvh::bruteForce(std::span<const Box3> boxes) {
  Bvh bvh;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) bvh.items_.push_back(i);
  return bvh;
}

Bvh::Bvh(std::span<const Box3> boxes) : Bvh(bruteForce(boxes)) {
  if (items_.empty()) return;
  Builder builder{boxes, std::vector<Vec3>(boxes.size()), nodes_, items_};
  for (std::uint32_t i : items_) builder.centers[i] = boxes[i].center();
  nodes_.reserve(2 * items_.size());
  nodes_.resize(1);
  builder.build(0, 0, static_cast<std::uint32_t>(items_.size()), 0);
}

}  // namespace trace
