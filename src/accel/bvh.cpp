#include "accel/bvh.h"

#include <algorithm>
#include <array>
#include <limits>

#include "accel/simd.h"
#include "base/parallel.h"

namespace trace {
namespace {

constexpr int kMostBins = 16;  // fewer where there are few items: most of the time goes into small nodes
constexpr int kDepthOfHeuristic = 60;     // deeper, nodes are halved by count: 32 more levels hold 2^32 items
constexpr std::uint32_t kSubtree = 8192;  // references that one thread takes at a time
constexpr float kCostOfNode = 0.5f, kCostOfLeaf = 1;  // of visiting one; a leaf's items are tested together

float roundDown(Real x) {
  const float f = static_cast<float>(x);
  return static_cast<Real>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float roundUp(Real x) { return -roundDown(-x); }

using simd::Float4;

/// A box in float, x y z and a fourth lane that means nothing. Empty as made.
struct Bounds {
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  Float4 low = Float4::all(kFar), high = Float4::all(-kFar);

  void extend(const Bounds& b) { low = min(low, b.low), high = max(high, b.high); }
  float halfArea() const {
    alignas(16) float size[4];
    (high - low).store(size);
    return size[0] < 0 ? 0 : size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
};

/// An item on its way into the tree.
struct Reference {
  float low[3], high[3];
  std::uint32_t item;
  /// Reads a float beyond each corner, but not beyond the reference.
  Bounds box() const { return {Float4::loadAnywhere(low), Float4::loadAnywhere(high)}; }
};

/// Of the binary tree.
struct Branch {
  Bounds box;
  std::uint32_t first;  ///< of the left child, the right one follows; of a leaf: the first reference
  std::uint32_t count;  ///< 0 for inner nodes
};

}  // namespace

struct Bvh::Builder {
  /// A part of the binary tree that a thread builds for itself: below branches[index], over these references.
  struct Subtree {
    std::uint32_t index, first, count;
    int depth;
    std::vector<Branch> branches{};
  };

  std::vector<Reference> references;
  std::vector<Branch> branches;
  Bvh& bvh;
  std::uint32_t leafSize;

  // --- the binary tree ---

  struct Split {
    float cost = Bounds::kFar;
    int axis = 0, bin = 0;
  };
  /// From a box to the bins of its centre.
  struct Bins {
    int count;
    Float4 low, scale;
    bool usable[3];
    void operator()(const Bounds& box, int (&bins)[4]) const {
      const Float4 place = ((box.low + box.high) - low) * scale;
      min(max(place, Float4::all(0)), Float4::all(static_cast<float>(count - 1))).storeWhole(bins);
    }
  };

  float leafCost(std::uint32_t count) const {
    const std::uint32_t leaves = (count + leafSize - 1) / leafSize;
    return kCostOfLeaf * static_cast<float>(leaves);
  }

  /// The cheapest of the planes between bins: on each side, half-area times the leaves its items fill.
  Split cheapestSplit(std::uint32_t first, std::uint32_t count, const Bins& bins) const {
    struct Bin {
      Bounds box;
      std::uint32_t count = 0;
    };
    std::array<std::array<Bin, kMostBins>, 3> all;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Bounds box = references[i].box();
      alignas(16) int number[4];
      bins(box, number);
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = all[static_cast<size_t>(axis)][static_cast<size_t>(number[axis])];
        bin.box.extend(box), ++bin.count;
      }
    }
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!bins.usable[axis]) continue;
      const auto& row = all[static_cast<size_t>(axis)];
      std::array<float, kMostBins> rightCost{};
      Bin right, left;
      const auto last = static_cast<size_t>(bins.count - 1);
      for (size_t b = last; b > 0; --b) {
        right.box.extend(row[b].box), right.count += row[b].count;
        rightCost[b] = right.box.halfArea() * leafCost(right.count);
      }
      for (size_t b = 0; b < last; ++b) {
        left.box.extend(row[b].box), left.count += row[b].count;
        if (left.count == 0 || left.count == count) continue;
        const float cost = left.box.halfArea() * leafCost(left.count) + rightCost[b + 1];
        if (cost < best.cost) best = {cost, axis, static_cast<int>(b)};
      }
    }
    return best;
  }

  /// Builds tree[index] and what is below; subtrees of up to kSubtree references go to `later`, if
  /// there is one.
  void branch(std::vector<Branch>& tree, std::uint32_t index, std::uint32_t first, std::uint32_t count,
              int depth, std::vector<Subtree>* later = nullptr) {
    if (later != nullptr && count <= kSubtree) {
      later->push_back({index, first, count, depth});
      return;
    }
    Bounds box, centers;  // twice the centres
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Bounds b = references[i].box();
      box.extend(b);
      centers.extend({b.low + b.high, b.low + b.high});
    }
    tree[index].box = box;

    alignas(16) float low[4], high[4], scale[4] = {};
    centers.low.store(low), centers.high.store(high);
    Bins bins{std::min(kMostBins, 8 + static_cast<int>(count / 16)), centers.low, {}, {}};
    for (int axis = 0; axis < 3; ++axis) {
      const float s = static_cast<float>(bins.count) * 0.9999f / (high[axis] - low[axis]);
      bins.usable[axis] = std::isfinite(s);
      scale[axis] = bins.usable[axis] ? s : 0;
    }
    bins.scale = Float4::loadAnywhere(scale);
    const Split split = depth < kDepthOfHeuristic && count > 1 ? cheapestSplit(first, count, bins) : Split{};
    const float asLeaf = box.halfArea() * leafCost(count), asNode = box.halfArea() * kCostOfNode + split.cost;
    if (count == 1 || (count <= leafSize && !(asNode < asLeaf))) {
      tree[index].first = first, tree[index].count = count;
      return;
    }
    const auto begin = references.begin() + first, end = begin + count;
    auto middle = begin + count / 2;  // items that no plane separates are halved by number
    if (split.cost < Bounds::kFar)
      middle = std::partition(begin, end, [&](const Reference& r) {
        alignas(16) int number[4];
        bins(r.box(), number);
        return number[split.axis] <= split.bin;
      });
    const auto leftCount = static_cast<std::uint32_t>(middle - begin);
    const auto children = static_cast<std::uint32_t>(tree.size());
    tree[index].first = children, tree[index].count = 0;
    tree.resize(tree.size() + 2);
    branch(tree, children, first, leftCount, depth + 1, later);
    branch(tree, children + 1, first + leftCount, count - leftCount, depth + 1, later);
  }

  /// The whole binary tree: its top, then the subtrees, which are the same whoever builds them.
  void buildBinary(int threads) {
    std::vector<Subtree> subtrees;
    branches.reserve(references.size());
    branches.resize(1);
    branch(branches, 0, 0, static_cast<std::uint32_t>(references.size()), 0, &subtrees);
    Job job;
    parallelChunks(static_cast<std::int64_t>(subtrees.size()), threads, job, [&](std::int64_t i, int) {
      Subtree& part = subtrees[static_cast<std::size_t>(i)];
      part.branches.reserve(part.count);
      part.branches.resize(1);
      branch(part.branches, 0, part.first, part.count, part.depth);
    });
    for (const Subtree& part : subtrees) {  // a part's root takes its place, the others are appended
      const auto shift = static_cast<std::uint32_t>(branches.size()) - 1;
      for (std::size_t i = 0; i < part.branches.size(); ++i) {
        Branch moved = part.branches[i];
        if (moved.count == 0) moved.first += shift;
        if (i == 0)
          branches[part.index] = moved;
        else
          branches.push_back(moved);
      }
    }
  }

  // --- eight to a node ---

  std::uint32_t addLeaf(const Branch& leaf) {
    const std::uint32_t number = bvh.leafCount();
    for (std::uint32_t i = 0; i < kLeafSize; ++i)
      bvh.items_.push_back(i < leaf.count ? references[leaf.first + i].item : kNoItem);
    return number | BvhNode::kLeaf;
  }

  /// Opens the largest inner child again and again until eight are found; writes the node and all below it.
  std::uint32_t collapse(std::uint32_t index) {
    std::array<std::uint32_t, 8> children{index};
    size_t count = 1;
    while (count < 8) {
      size_t largest = 8;
      for (size_t i = 0; i < count; ++i) {
        const Branch& b = branches[children[i]];
        if (b.count == 0 && (largest == 8 || b.box.halfArea() > branches[children[largest]].box.halfArea()))
          largest = i;
      }
      if (largest == 8) break;
      const std::uint32_t left = branches[children[largest]].first;
      children[largest] = left, children[count++] = left + 1;
    }

    const auto number = static_cast<std::uint32_t>(bvh.nodes_.size());
    bvh.nodes_.emplace_back();
    for (size_t lane = 0; lane < 8; ++lane) {
      Bounds box;
      std::uint32_t child = BvhNode::kLeaf;
      if (lane < count) {
        const Branch& b = branches[children[lane]];
        box = b.box;
        child = b.count > 0 ? addLeaf(b) : collapse(children[lane]);
      }
      BvhNode& node = bvh.nodes_[number];
      alignas(16) float low[4], high[4];
      box.low.store(low), box.high.store(high);
      for (int axis = 0; axis < 3; ++axis)
        node.plane[axis][0][lane] = low[axis], node.plane[axis][1][lane] = high[axis];
      node.child[lane] = child;
    }
    return number * kNodePlaces;
  }
};

Bvh::Bvh(std::span<const Box3> boxes, Leaves leaves, int threads) {
  Box3 whole;
  for (const Box3& box : boxes)
    if (!box.empty()) whole.extend(box);
  if (whole.empty()) return;

  // The slab test's rounding moves a box's face by less than 2^-19 of the largest coordinate m: the ray's
  // origin, at most 4 m away, and its product with the inverse direction by 2^-22 m each; the inverse
  // direction, with the distance of at most 5 m, by 2^-20.6 m; the face's own product and the difference by
  // 2^-21.4 m.
  const Real largest = max(maxComponent(abs(whole.low)), maxComponent(abs(whole.high)));
  const Real pad = largest * 0x1p-19;
  extent_.reach = static_cast<float>(4 * largest);
  for (int axis = 0; axis < 3; ++axis)
    extent_.low[axis] = whole.low[axis] - pad, extent_.high[axis] = whole.high[axis] + pad;

  Builder builder{{}, {}, *this, leaves == Leaves::single ? 1u : kLeafSize};
  builder.references.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].empty()) continue;
    Reference r{{}, {}, i};
    for (int axis = 0; axis < 3; ++axis) {
      r.low[axis] = roundDown(boxes[i].low[axis] - pad);
      r.high[axis] = roundUp(boxes[i].high[axis] + pad);
    }
    builder.references.push_back(r);
  }
  if (builder.references.size() <= kLeafSize) {
    *this = bruteForce(boxes);
    return;
  }
  builder.buildBinary(threads);
  builder.collapse(0);
  nodes_.shrink_to_fit(), items_.shrink_to_fit();
}

Bvh Bvh::bruteForce(std::span<const Box3> boxes) {
  Bvh bvh;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) bvh.items_.push_back(i);
  while (bvh.items_.size() % kLeafSize != 0) bvh.items_.push_back(kNoItem);
  return bvh;
}

}  // namespace trace
