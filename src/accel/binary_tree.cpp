#include "accel/binary_tree.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/budget.h"
#include "base/parallel.h"

namespace trace {
namespace {

using simd::Float4;

constexpr std::size_t kMostBins = 32;     // fewer where there are few items: most time goes into small nodes
constexpr std::uint32_t kFew = 16;        // so few items are sorted, and every plane between them is tried
constexpr int kDepthOfHeuristic = 48;     // deeper, nodes are halved by count
constexpr std::uint32_t kSubtree = 8192;  // items that one thread takes at a time
static_assert(kMostDepthBuilt == kDepthOfHeuristic + 28 + kFew - 1);  // 28 times halved, 2^32 are few

/// Three boxes, one in each lane, coordinate by coordinate.
struct ThreeBoxes {
  Float4 low[3] = {Float4::all(Bounds::kFar), Float4::all(Bounds::kFar), Float4::all(Bounds::kFar)},
         high[3] = {Float4::all(-Bounds::kFar), Float4::all(-Bounds::kFar), Float4::all(-Bounds::kFar)};

  void set(const Bounds& a, const Bounds& b, const Bounds& c) {
    transpose(a.low, b.low, c.low, c.low, low);
    transpose(a.high, b.high, c.high, c.high, high);
  }
  void extend(const ThreeBoxes& b) {
    for (int i = 0; i < 3; ++i) {
      low[i] = min(low[i], b.low[i]);
      high[i] = max(high[i], b.high[i]);
    }
  }
  Float4 halfArea() const {
    const Float4 x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + (x + y) * z;
  }
};

/// The box and the number of the items between two planes across each axis, one axis in each lane.
struct Slices {
  ThreeBoxes box;
  Float4 count;
};

struct Split {
  float cost = Bounds::kFar;
  int axis = 0;
  std::uint32_t slice = 0;  ///< the last on the left
};

class BinaryTree {
 public:
  BinaryTree(std::span<BoxedItem> items, std::uint32_t leafSize) : items_(items), leafSize_(leafSize) {}

  std::vector<Branch> build(int threads);

 private:
  /// A part of the tree that a thread builds for itself: below branches[index], over these items.
  struct Subtree {
    std::uint32_t index, first, count;
    int depth;
    Bounds box;
    std::vector<Branch> branches{};
  };

  /// Up to kFew items, and their orders by centre along the axes, of which each branch has a stretch.
  struct Few {
    std::array<Bounds, kFew> box;
    std::array<std::array<std::uint8_t, kFew>, 3> order;
  };

  /// Half-area times the leaves that so many items fill.
  Float4 cost(const Slices& s) const {
    const auto size = static_cast<float>(leafSize_);
    return s.box.halfArea() * truncated((s.count + Float4::all(size - 1)) * Float4::all(1 / size));
  }

  /// The cheapest of the planes between slices.
  Split cheapestSplit(std::span<const Slices> slices) const {
    std::array<Float4, kMostBins> rightCost;
    Slices side = slices.back();
    for (std::size_t i = slices.size() - 1; i > 0; --i) {
      rightCost[i] = cost(side);
      side.box.extend(slices[i - 1].box);
      side.count = side.count + slices[i - 1].count;
    }
    // An empty side costs infinity times 0, which is not a number and so never the least.
    side = slices.front();
    Float4 least = Float4::all(Bounds::kFar), at = Float4::all(0);
    for (std::size_t i = 1; i < slices.size(); ++i) {
      const Float4 both = cost(side) + rightCost[i];
      at = whereLess(both, least, Float4::all(static_cast<float>(i - 1)), at);
      least = min(both, least);
      side.box.extend(slices[i].box);
      side.count = side.count + slices[i].count;
    }
    alignas(16) float costs[4], places[4];
    least.store(costs);
    at.store(places);
    Split best;
    for (int axis = 0; axis < 3; ++axis)
      if (costs[axis] < best.cost) best = {costs[axis], axis, static_cast<std::uint32_t>(places[axis])};
    return best;
  }

  bool staysLeaf(const Bounds& box, std::uint32_t count, const Split& split) const {
    const float area = box.halfArea();
    return count <= leafSize_ && !(area * kCostOfNode + split.cost < area * leafCost(count, leafSize_));
  }

  void branch(std::vector<Branch>& tree, std::uint32_t index, std::uint32_t first, std::uint32_t count,
              const Bounds& box, int depth, std::vector<Subtree>* later = nullptr);
  void few(std::vector<Branch>& tree, std::uint32_t index, std::uint32_t first, std::uint32_t count,
           const Bounds& box);
  void fewBranch(std::vector<Branch>& tree, std::uint32_t index, Few& few, std::uint32_t begin,
                 std::uint32_t count, const Bounds& box, std::uint32_t first);

  std::span<BoxedItem> items_;
  std::uint32_t leafSize_;
};

/// Equal bins along each axis, and the boxes and numbers of the items whose centres lie in them.
class Bins {
 public:
  explicit Bins(std::span<const BoxedItem> items)
      : count_(std::min<std::size_t>(kMostBins, 16 + items.size() / 8)) {
    Bounds centers;  // twice
    for (const BoxedItem& item : items) {
      const Bounds box = boxOf(item);
      centers.extend({box.low + box.high, box.low + box.high});
    }
    // A side of no length has all its centres in the first bin.
    const Float4 low = centers.low, last = Float4::all(static_cast<float>(count_ - 1)),
                 scale = Float4::all(static_cast<float>(count_) * 0.9999f) /
                         max(centers.high - low, Float4::all(std::numeric_limits<float>::min()));
    low_ = low;
    scale_ = scale;
    for (std::size_t i = 0; i < count_; ++i) bins_[i] = {};
    for (const BoxedItem& item : items) {
      const Bounds box = boxOf(item);
      alignas(16) int number[4];
      min((box.low + box.high - low) * scale, last).storeWhole(number);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Bin& bin = bins_[static_cast<std::size_t>(number[axis])];
        bin.box[axis].extend(box);
        ++bin.count[axis];
      }
    }
  }

  std::span<const Slices> slices(std::array<Slices, kMostBins>& slices) const {
    for (std::size_t i = 0; i < count_; ++i) {
      slices[i].box.set(bins_[i].box[0], bins_[i].box[1], bins_[i].box[2]);
      slices[i].count = Float4::ofWhole(bins_[i].count.data());
    }
    return std::span(slices).first(count_);
  }

  /// Puts the items on the left first; returns their number.
  std::uint32_t part(std::span<BoxedItem> items, const Split& split, Bounds& left, Bounds& right) const {
    const auto axis = static_cast<std::size_t>(split.axis);
    for (std::size_t i = 0; i < count_; ++i) (i <= split.slice ? left : right).extend(bins_[i].box[axis]);
    alignas(16) float low[4], scale[4];
    low_.store(low);
    scale_.store(scale);
    const float edge = static_cast<float>(split.slice + 1);
    std::uint32_t leftCount = 0;
    for (BoxedItem& item : items) {
      // As above: the same operations give the same bin. Without a branch, which would be guessed wrongly.
      const bool isLeft = (item.low[axis] + item.high[axis] - low[axis]) * scale[axis] < edge;
      swap(item, items[leftCount]);
      leftCount += isLeft;
    }
    return leftCount;
  }

 private:
  struct Bin {
    std::array<Bounds, 3> box;
    alignas(16) std::array<std::int32_t, 4> count{};
  };

  std::size_t count_;
  Float4 low_, scale_;
  std::array<Bin, kMostBins> bins_;
};

/// Builds tree[index] and what is below; subtrees of up to kSubtree items go to `later`, if there is one.
void BinaryTree::branch(std::vector<Branch>& tree, std::uint32_t index, std::uint32_t first,
                        std::uint32_t count, const Bounds& box, int depth, std::vector<Subtree>* later) {
  if (later != nullptr && count <= kSubtree) {
    later->push_back({index, first, count, depth, box});
    return;
  }
  if (count <= kFew) return few(tree, index, first, count, box);

  const std::span some = items_.subspan(first, count);
  Bounds left, right;
  std::uint32_t leftCount = 0;
  if (depth < kDepthOfHeuristic) {
    const Bins bins(some);
    std::array<Slices, kMostBins> room;
    const Split split = cheapestSplit(bins.slices(room));
    if (split.cost < Bounds::kFar) leftCount = bins.part(some, split, left, right);
  }
  if (leftCount == 0) {  // items that no plane separates are halved by number
    leftCount = count / 2;
    for (std::uint32_t i = 0; i < count; ++i) (i < leftCount ? left : right).extend(boxOf(some[i]));
  }
  const auto children = static_cast<std::uint32_t>(tree.size());
  set(tree[index], box, children, 0);
  tree.resize(tree.size() + 2);
  branch(tree, children, first, leftCount, left, depth + 1, later);
  branch(tree, children + 1, first + leftCount, count - leftCount, right, depth + 1, later);
}

/// Sorts the items once for all that is below, which then only parts the three orders.
void BinaryTree::few(std::vector<Branch>& tree, std::uint32_t index, std::uint32_t first, std::uint32_t count,
                     const Bounds& box) {
  const std::span some = items_.subspan(first, count);
  Few few;
  std::array<Float4, kFew> center, rank;
  std::array<std::uint32_t, kFew> names;
  for (std::uint32_t i = 0; i < count; ++i) {
    few.box[i] = boxOf(some[i]);
    names[i] = some[i].item;
    center[i] = few.box[i].low + few.box[i].high;
    Float4 before = Float4::all(0);
    for (std::uint32_t j = 0; j < i; ++j) {
      const Float4 after = step(center[j], center[i]);
      before = before + after;
      rank[j] = rank[j] + (Float4::all(1) - after);
    }
    rank[i] = before;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    alignas(16) int number[4];
    rank[i].storeWhole(number);
    for (std::size_t axis = 0; axis < 3; ++axis)
      few.order[axis][static_cast<std::size_t>(number[axis])] = static_cast<std::uint8_t>(i);
  }
  fewBranch(tree, index, few, 0, count, box, first);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint8_t old = few.order[0][i];
    few.box[old].low.store(some[i].low);
    few.box[old].high.store(some[i].high);
    some[i].item = names[old];
  }
}

/// Builds tree[index] and what is below of the items at begin, ... in the orders.
void BinaryTree::fewBranch(std::vector<Branch>& tree, std::uint32_t index, Few& few, std::uint32_t begin,
                           std::uint32_t count, const Bounds& box, std::uint32_t first) {
  checkBudget();
  Split split;
  if (count > 1) {
    std::array<Slices, kFew> slices;
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto at = [&](std::size_t axis) { return few.box[few.order[axis][begin + i]]; };
      slices[i].box.set(at(0), at(1), at(2));
      slices[i].count = Float4::all(1);
    }
    split = cheapestSplit(std::span(slices).first(count));
  }
  if (count == 1 || staysLeaf(box, count, split)) return set(tree[index], box, first + begin, count);
  if (!(split.cost < Bounds::kFar)) split.slice = (count - 1) / 2;  // their areas are infinite

  const std::uint32_t leftCount = split.slice + 1;
  Bounds left, right;
  unsigned isLeft = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint8_t item = few.order[static_cast<std::size_t>(split.axis)][begin + i];
    (i < leftCount ? left : right).extend(few.box[item]);
    isLeft |= (i < leftCount ? 1u : 0u) << item;
  }
  for (std::array<std::uint8_t, kFew>& order : few.order) {
    std::array<std::uint8_t, kFew> others;  // that go right
    std::uint32_t l = begin, r = 0;
    for (std::uint32_t i = begin; i < begin + count; ++i) {
      const std::uint8_t item = order[i];
      const unsigned goesLeft = isLeft >> item & 1;
      order[l] = item;
      others[r] = item;
      l += goesLeft;
      r += 1 - goesLeft;
    }
    std::copy_n(others.begin(), r, order.begin() + l);
  }
  const auto children = static_cast<std::uint32_t>(tree.size());
  set(tree[index], box, children, 0);
  tree.resize(tree.size() + 2);
  fewBranch(tree, children, few, begin, leftCount, left, first);
  fewBranch(tree, children + 1, few, begin + leftCount, count - leftCount, right, first);
}

/// By several threads: the top of the tree, then the subtrees, which are the same whoever builds them.
std::vector<Branch> BinaryTree::build(int threads) {
  std::vector<Branch> branches(1);
  std::vector<Subtree> subtrees;
  Bounds whole;
  for (const BoxedItem& item : items_) whole.extend(boxOf(item));
  branches.reserve(items_.size());
  branch(branches, 0, 0, static_cast<std::uint32_t>(items_.size()), whole, 0,
         threads == 1 ? nullptr : &subtrees);
  Job job;
  parallelChunks(static_cast<std::int64_t>(subtrees.size()), threads, job, [&](std::int64_t i, int) {
    Subtree& part = subtrees[static_cast<std::size_t>(i)];
    part.branches.reserve(part.count);
    part.branches.resize(1);
    branch(part.branches, 0, part.first, part.count, part.box, part.depth);
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
  return branches;
}

}  // namespace

std::vector<Branch> binaryTree(std::span<BoxedItem> items, std::uint32_t leafSize, int threads) {
  return BinaryTree(items, leafSize).build(threads);
}

}  // namespace trace
