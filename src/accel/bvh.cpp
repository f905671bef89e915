#include "accel/bvh.h"

#include <algorithm>
#include <array>
#include <limits>

#include "accel/binary_tree.h"
#include "accel/reinsertion.h"

namespace trace {

/// Makes nodes of eight children of the binary tree.
struct Bvh::Builder {
  std::span<const BoxedItem> items;
  std::span<const Branch> branches;
  std::uint32_t leafSize;
  simd::Float4 pad;
  Bvh& bvh;

  std::uint32_t addLeaf(const Branch& leaf) {
    if (leafSize == 1) {
      bvh.items_.push_back(items[leaf.first].item);
      return bvh.items_.back() | BvhNode::kLeaf;
    }
    const std::uint32_t number = bvh.leafCount();
    std::array<std::uint32_t, kLeafSize> names;
    for (std::uint32_t i = 0; i < kLeafSize; ++i)
      names[i] = i < leaf.count ? items[leaf.first + i].item : kNoItem;
    bvh.items_.insert(bvh.items_.end(), names.begin(), names.end());
    return number * kLeafPlaces | BvhNode::kLeaf;
  }

  /// A branch as at most 1, 2, ... 7 children of a node: what that costs at the least, and how many of 2, ...
  /// 7, and of the 8 that its own node has, come from its left child; 0: none, one child less is as good.
  struct Forests {
    std::array<float, 8> cost;
    std::array<std::uint8_t, 9> left;
    float itemArea;  ///< item area of the boxes of all items
  };
  std::vector<Forests> forests = std::vector<Forests>(branches.size() / 2);  ///< inner branches, by pairs
  Forests& forestsOf(const Branch& inner) { return forests[inner.first / 2]; }
  std::array<float, 8> costsOf(const Branch& b) {
    if (b.count == 0) return forestsOf(b).cost;
    std::array<float, 8> costs;
    costs.fill(boxOf(b).halfArea() * leafCost(b.count, leafSize));
    return costs;
  }

  float itemArea(const Branch& b) {
    if (b.count == 0) return forestsOf(b).itemArea;
    float sum = 0;
    for (const BoxedItem& item : items.subspan(b.first, b.count)) sum += boxOf(item).halfArea();
    return sum;
  }
  /// How full of items the box is: the likelier a ray that hits the one ends at the others.
  float density(const Branch& b) {
    const float density = itemArea(b) / boxOf(b).halfArea();
    return density >= 0 ? density : 0;  // 0 / 0 is a point
  }

  /// Ylitie, Karras and Laine 2017, Efficient incoherent ray traversal on GPUs through compressed wide BVHs,
  /// section 3: from the leaves up, the cheapest forest of each size. For a branch and all below.
  void planCollapse(std::uint32_t index) {
    const Branch& b = branches[index];
    if (b.count > 0) return;
    planCollapse(b.first);
    planCollapse(b.first + 1);
    Forests& f = forestsOf(b);
    const std::array<float, 8> left = costsOf(branches[b.first]), right = costsOf(branches[b.first + 1]);
    const auto parted = [&](std::uint8_t into) {
      float best = Bounds::kFar;
      for (std::uint8_t k = 1; k < into; ++k) {
        const float cost = left[k] + right[into - k];
        if (k == 1 || cost < best) {
          best = cost;
          f.left[into] = k;
        }
      }
      return best;
    };
    f.itemArea = itemArea(branches[b.first]) + itemArea(branches[b.first + 1]);
    f.cost[1] = boxOf(b).halfArea() * kCostOfNode + parted(8);
    for (std::uint8_t into = 2; into < 8; ++into) {
      f.cost[into] = parted(into);
      if (f.cost[into - 1] <= f.cost[into]) {
        f.cost[into] = f.cost[into - 1];
        f.left[into] = 0;
      }
    }
  }

  /// The children of a node: branches, and how dense they are.
  struct Children {
    struct Child {
      std::uint32_t branch;
      float density;
    };
    std::array<Child, 8> all;
    std::size_t count = 0;
  };

  /// Adds to `children` what a branch becomes as at most so many of a node's.
  void addForest(std::uint32_t index, std::uint8_t most, Children& children) {
    const Branch& b = branches[index];
    while (most > 1 && b.count == 0 && forestsOf(b).left[most] == 0) --most;
    if (most == 1 || b.count > 0) {
      children.all[children.count++] = {index, density(b)};
      return;
    }
    const std::uint8_t left = forestsOf(b).left[most];
    addForest(b.first, left, children);
    addForest(b.first + 1, static_cast<std::uint8_t>(most - left), children);
  }

  /// Writes the node of a branch and all below it.
  std::uint32_t collapse(std::uint32_t index) {
    Children children;
    addForest(index, 8, children);
    // Denser ones first, in the order in which a query for any hit takes the lanes: see traverse().
    const std::span some(children.all.begin(), children.count);
    std::sort(some.begin(), some.end(), [](const auto& a, const auto& b) {
      return a.density != b.density ? a.density < b.density : a.branch < b.branch;
    });
    std::rotate(some.begin(), some.end() - 1, some.end());
    const auto number = static_cast<std::uint32_t>(bvh.nodes_.size());
    bvh.nodes_.emplace_back();
    for (size_t lane = 0; lane < 8; ++lane) {
      Bounds box;
      std::uint32_t child = BvhNode::kLeaf;
      if (lane < some.size()) {
        const Branch& b = branches[some[lane].branch];
        box = {boxOf(b).low - pad, boxOf(b).high + pad};
        child = b.count > 0 ? addLeaf(b) : collapse(some[lane].branch);
      }
      BvhNode& node = bvh.nodes_[number];
      alignas(16) float low[4], high[4];
      box.low.store(low);
      box.high.store(high);
      for (int axis = 0; axis < 3; ++axis) {
        node.plane[axis][0][lane] = low[axis];
        node.plane[axis][1][lane] = high[axis];
      }
      node.child[lane] = child;
    }
    return number * kNodePlaces;
  }
};

Bvh::Bvh(std::span<const Box3> boxes, Leaves leaves, int threads) {
  constexpr Real kLargest = std::numeric_limits<float>::max();
  constexpr Vec3 kMost{kLargest, kLargest, kLargest};
  Box3 whole;
  std::vector<BoxedItem> items;
  items.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].empty()) continue;
    whole.extend(boxes[i]);
    // The padding of a box beyond what a float holds is so large that it becomes infinite, as it should.
    items.push_back(boxedItem({max(boxes[i].low, -kMost), min(boxes[i].high, kMost)}, i));
  }
  build(std::move(items), whole, leaves, threads);
}

Bvh::Bvh(std::vector<BoxedItem> items, Leaves leaves, int threads) {
  Bounds all;
  for (const BoxedItem& item : items) all.extend(boxOf(item));
  build(std::move(items), box3(all), leaves, threads);
}

void Bvh::build(std::vector<BoxedItem> items, const Box3& whole, Leaves leaves, int threads) {
  if (items.size() <= kLeafSize) {
    *this = bruteForce(items);
    return;
  }
  // The slab test's rounding moves a box's face by less than 2^-19 of the largest coordinate m: the ray's
  // origin, at most 4 m away, and its product with the inverse direction by 2^-22 m each; the inverse
  // direction, with the distance of at most 5 m, by 2^-20.6 m; the face's own product and the difference by
  // 2^-21.4 m; the padded face itself by 2^-23 m.
  const Real largest = max(maxComponent(abs(whole.low)), maxComponent(abs(whole.high)));
  const Real pad = largest * 0x1p-19;
  extent_.reach = static_cast<float>(4 * largest);
  for (int axis = 0; axis < 3; ++axis) {
    extent_.low[axis] = whole.low[axis] - pad;
    extent_.high[axis] = whole.high[axis] + pad;
  }

  const std::uint32_t leafSize = leaves == Leaves::single ? 1 : kLeafSize;
  std::vector<Branch> branches = binaryTree(items, leafSize, threads);
  reinsertLargeBranches(branches);
  Builder builder{items, branches, leafSize, simd::Float4::all(floatAbove(pad)), *this};
  const std::size_t leafCount = (branches.size() + 1) / 2;
  items_.reserve(leafCount * leafSize);
  nodes_.reserve(leafCount / 4 + 1);  // most nodes have more children; what is not written takes no memory
  builder.planCollapse(0);
  builder.collapse(0);
}

Bvh Bvh::bruteForce(std::span<const Box3> boxes) {
  Bvh bvh;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (!boxes[i].empty()) bvh.items_.push_back(i);
  return bvh;
}

Bvh Bvh::bruteForce(std::span<const BoxedItem> items) {
  Bvh bvh;
  for (const BoxedItem& item : items) bvh.items_.push_back(item.item);
  return bvh;
}

}  // namespace trace
