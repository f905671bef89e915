#include "accel/bvh.h"

#include <algorithm>
#include <array>
#include <limits>

#include "accel/simd.h"
#include "base/parallel.h"

namespace trace {
namespace {

constexpr int kMostBins = 32;       // fewer where there are few items: most of the time goes into small nodes
constexpr std::uint32_t kFew = 16;  // so few items get a bin each, in the order of their centres
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
    const Float4 size = max(high - low, Float4::all(0)), products = size * rotate(size);
    return first(products + rotate(products) + rotate(rotate(products)));
  }
};

/// An item on its way into the tree.
struct Reference {
  float low[3], high[3];
  std::uint32_t item;
  std::uint8_t bin[4];  ///< on each axis, of the node that is being split
  /// Reads a float beyond each corner, but not beyond the reference.
  Bounds box() const { return {Float4::loadAnywhere(low), Float4::loadAnywhere(high)}; }
};

/// The boxes of some references: all of each, and twice their centres.
struct Extent {
  Bounds box, centers;
  void extend(const Bounds& b) {
    box.extend(b);
    centers.extend({b.low + b.high, b.low + b.high});
  }
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
    Extent extent;
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

  float leafCost(std::uint32_t count) const {
    const std::uint32_t leaves = leafSize == 1 ? count : (count + kLeafSize - 1) / kLeafSize;
    return kCostOfLeaf * static_cast<float>(leaves);
  }

  /// Gives each reference its bins, for its centre; returns how many there are on each axis.
  static int intoBins(std::span<Reference> some, const Bounds& centers) {
    alignas(16) int number[4];
    const auto setBins = [&](Reference& r) {
      for (int axis = 0; axis < 3; ++axis) r.bin[axis] = static_cast<std::uint8_t>(number[axis]);
    };
    if (some.size() <= kFew) {
      std::array<Float4, kFew> center, rank;
      for (std::size_t i = 0; i < some.size(); ++i) {
        const Bounds box = some[i].box();
        center[i] = box.low + box.high, rank[i] = Float4::all(0);
        for (std::size_t j = 0; j < i; ++j) {
          const Float4 after = step(center[j], center[i]);
          rank[i] = rank[i] + after, rank[j] = rank[j] + (Float4::all(1) - after);
        }
      }
      for (std::size_t i = 0; i < some.size(); ++i) rank[i].storeWhole(number), setBins(some[i]);
      return static_cast<int>(some.size());
    }
    const int count = std::min(kMostBins, 16 + static_cast<int>(some.size() / 8));
    // A side of no length has all its centres in the first bin.
    const Float4 most = Float4::all(static_cast<float>(count - 1)),
                 scale = Float4::all(static_cast<float>(count) * 0.9999f) /
                         max(centers.high - centers.low, Float4::all(std::numeric_limits<float>::min()));
    for (Reference& r : some) {
      const Bounds box = r.box();
      min((box.low + box.high - centers.low) * scale, most).storeWhole(number), setBins(r);
    }
    return count;
  }

  /// The cheapest of the planes between bins: on each side, half-area times the leaves its items fill.
  Split cheapestSplit(std::span<const Reference> some, int bins) const {
    struct Bin {
      Bounds box;
      std::uint32_t count;
    };
    std::array<std::array<Bin, 3>, kMostBins> all;
    const auto last = static_cast<std::size_t>(bins - 1);
    for (std::size_t b = 0; b <= last; ++b) all[b].fill({{}, 0});
    for (const Reference& r : some) {
      const Bounds box = r.box();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Bin& bin = all[r.bin[axis]][axis];
        bin.box.extend(box), ++bin.count;
      }
    }
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<float, kMostBins> rightCost;
      Bin right{{}, 0}, left{{}, 0};
      for (std::size_t b = last; b > 0; --b) {
        right.box.extend(all[b][axis].box), right.count += all[b][axis].count;
        rightCost[b] = right.box.halfArea() * leafCost(right.count);
      }
      for (std::size_t b = 0; b < last; ++b) {
        left.box.extend(all[b][axis].box), left.count += all[b][axis].count;
        if (left.count == 0) continue;
        if (left.count == some.size()) break;
        const float cost = left.box.halfArea() * leafCost(left.count) + rightCost[b + 1];
        if (cost < best.cost) best = {cost, static_cast<int>(axis), static_cast<int>(b)};
      }
    }
    return best;
  }

  /// Builds tree[index] and what is below; subtrees of up to kSubtree references go to `later`, if
  /// there is one.
  void branch(std::vector<Branch>& tree, std::uint32_t index, std::uint32_t first, std::uint32_t count,
              const Extent& extent, int depth, std::vector<Subtree>* later = nullptr) {
    if (later != nullptr && count <= kSubtree) {
      later->push_back({index, first, count, depth, extent});
      return;
    }
    const Bounds& box = extent.box;
    tree[index].box = box;
    const std::span some = std::span(references).subspan(first, count);
    const Split split = depth < kDepthOfHeuristic && count > 1
                            ? cheapestSplit(some, intoBins(some, extent.centers))
                            : Split{};
    const float asLeaf = box.halfArea() * leafCost(count), asNode = box.halfArea() * kCostOfNode + split.cost;
    if (count == 1 || (count <= leafSize && !(asNode < asLeaf))) {
      tree[index].first = first, tree[index].count = count;
      return;
    }
    Extent left, right;
    const bool halve = !(split.cost < Bounds::kFar);  // items that no plane separates are halved by number
    const auto half = some.begin() + count / 2;
    const auto isLeft = [&](const Reference& r) {
      const bool is = halve ? &r < &*half : r.bin[split.axis] <= split.bin;
      (is ? left : right).extend(r.box());
      return is;
    };
    const auto middle = std::partition(some.begin(), some.end(), isLeft);
    const auto leftCount = static_cast<std::uint32_t>(middle - some.begin());
    const auto children = static_cast<std::uint32_t>(tree.size());
    tree[index].first = children, tree[index].count = 0;
    tree.resize(tree.size() + 2);
    branch(tree, children, first, leftCount, left, depth + 1, later);
    branch(tree, children + 1, first + leftCount, count - leftCount, right, depth + 1, later);
  }

  /// The whole binary tree: its top, then the subtrees, which are the same whoever builds them.
  void buildBinary(int threads) {
    std::vector<Subtree> subtrees;
    branches.reserve(references.size());
    branches.resize(1);
    Extent whole;
    for (const Reference& r : references) whole.extend(r.box());
    branch(branches, 0, 0, static_cast<std::uint32_t>(references.size()), whole, 0, &subtrees);
    Job job;
    parallelChunks(static_cast<std::int64_t>(subtrees.size()), threads, job, [&](std::int64_t i, int) {
      Subtree& part = subtrees[static_cast<std::size_t>(i)];
      part.branches.reserve(part.count);
      part.branches.resize(1);
      branch(part.branches, 0, part.first, part.count, part.extent, part.depth);
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

  /// A branch as at most 1, 2, ... 7 children of a node: what that costs at the least, and how many of 2, ...
  /// 7, and of the 8 that its own node has, come from its left child; 0: none, one child less is as good.
  struct Forests {
    std::array<float, 8> cost;
    std::array<std::uint8_t, 9> left;
  };
  std::vector<Forests> forests{};

  /// Ylitie, Karras and Laine 2017, Efficient incoherent ray traversal on GPUs through compressed wide BVHs,
  /// section 3: from the leaves up, the cheapest forest of each size.
  void planCollapse() {
    forests.resize(branches.size());
    for (std::size_t i = branches.size(); i-- > 0;) {  // children lie behind their parents
      const Branch& b = branches[i];
      Forests& f = forests[i];
      f.left = {};
      if (b.count > 0) {
        f.cost.fill(b.box.halfArea() * leafCost(b.count));
        continue;
      }
      const Forests &left = forests[b.first], &right = forests[b.first + 1];
      const auto parted = [&](std::uint8_t into) {
        float best = Bounds::kFar;
        for (std::uint8_t k = 1; k < into; ++k) {
          const float cost = left.cost[k] + right.cost[into - k];
          if (k == 1 || cost < best) best = cost, f.left[into] = k;
        }
        return best;
      };
      f.cost[1] = b.box.halfArea() * kCostOfNode + parted(8);
      for (std::uint8_t into = 2; into < 8; ++into) {
        f.cost[into] = parted(into);
        if (f.cost[into - 1] <= f.cost[into]) f.cost[into] = f.cost[into - 1], f.left[into] = 0;
      }
    }
  }

  /// Adds to `children` what a branch becomes as at most so many of a node's.
  void addForest(std::uint32_t index, std::uint8_t most, std::vector<std::uint32_t>& children) const {
    const Branch& b = branches[index];
    while (most > 1 && forests[index].left[most] == 0) --most;
    if (most == 1) return children.push_back(index);
    const std::uint8_t left = forests[index].left[most];
    addForest(b.first, left, children);
    addForest(b.first + 1, static_cast<std::uint8_t>(most - left), children);
  }

  /// Writes the node of a branch and all below it.
  std::uint32_t collapse(std::uint32_t index) {
    std::vector<std::uint32_t> children;
    children.reserve(8);
    addForest(index, 8, children);
    // Larger ones first, in the order in which a query for any hit takes the lanes: see traverse().
    std::sort(children.begin(), children.end(), [&](std::uint32_t a, std::uint32_t b) {
      return branches[a].box.halfArea() < branches[b].box.halfArea();
    });
    std::rotate(children.begin(), children.end() - 1, children.end());
    const auto number = static_cast<std::uint32_t>(bvh.nodes_.size());
    bvh.nodes_.emplace_back();
    for (size_t lane = 0; lane < 8; ++lane) {
      Bounds box;
      std::uint32_t child = BvhNode::kLeaf;
      if (lane < children.size()) {
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
    Reference r{{}, {}, i, {}};
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
  builder.planCollapse();
  builder.collapse(0);
  nodes_.shrink_to_fit(), items_.shrink_to_fit();
}

Bvh Bvh::bruteForce(std::span<const Box3> boxes) {
  Bvh bvh;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) bvh.items_.push_back(i);
  return bvh;
}

}  // namespace trace
