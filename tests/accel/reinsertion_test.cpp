#include "accel/reinsertion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "accel/bvh_node.h"
#include "support/random.h"

namespace trace::test {
namespace {

struct Tree {
  std::vector<BoxedItem> items;
  std::vector<Branch> branches;
};

/// A tree over boxes that box(i) makes.
Tree treeOf(int count, const std::function<Box3(int)>& box) {
  Tree tree;
  for (int i = 0; i < count; ++i) tree.items.push_back(boxedItem(box(i), static_cast<std::uint32_t>(i)));
  tree.branches = binaryTree(tree.items, 4, 1);
  return tree;
}

/// The area of all inner boxes, as a share of the whole. Checks on the way that boxes hold what is below
/// them, and that no item lies too deep; adds the items to `found`.
double innerArea(const Tree& tree, std::multiset<std::uint32_t>& found) {
  const std::function<double(std::uint32_t, int)> below = [&](std::uint32_t index, int depth) -> double {
    const Branch& b = tree.branches[index];
    EXPECT_LE(depth, BvhNode::kMostDepth);
    const auto holds = [&](const auto& inner) {
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(b.low[axis] <= inner.low[axis] && inner.high[axis] <= b.high[axis]) << index;
    };
    for (std::uint32_t i = 0; i < b.count; ++i)
      holds(tree.items[b.first + i]), found.insert(tree.items[b.first + i].item);
    if (b.count > 0) return 0;
    holds(tree.branches[b.first]), holds(tree.branches[b.first + 1]);
    return static_cast<double>(boxOf(b).halfArea()) + below(b.first, depth + 1) +
           below(b.first + 1, depth + 1);
  };
  return below(0, 0) / static_cast<double>(boxOf(tree.branches[0]).halfArea());
}

/// Inner areas before and after, when both trees have been checked.
std::pair<double, double> reinserted(Tree tree) {
  std::multiset<std::uint32_t> before, after;
  const double old = innerArea(tree, before);
  const std::size_t size = tree.branches.size();
  reinsertLargeBranches(tree.branches);
  const double now = innerArea(tree, after);
  EXPECT_EQ(before, after);
  EXPECT_EQ(tree.branches.size(), size);
  return {old, now};
}

Box3 boxAt(const Vec3& center, const Vec3& size) {
  return {center - abs(size) * 0.5, center + abs(size) * 0.5};
}

TEST(Reinsertion, MakesInnerBoxesOfABuildingSmaller) {
  Random random(1);
  const auto [before, after] = reinserted(treeOf(3000, [&](int i) {  // beams and walls among small things
    Vec3 size = random.inCube(0.2);
    if (i % 10 == 0) size[random.below(3)] = 10;
    if (i % 20 == 0) size[random.below(3)] = 10;
    return boxAt(random.inCube(10), size);
  }));
  EXPECT_LT(after, 0.95 * before);
}

TEST(Reinsertion, LeavesAScanAlone) {
  Random random(2);
  const auto [before, after] =
      reinserted(treeOf(3000, [&](int) { return boxAt(random.direction(), random.inCube(0.05)); }));
  EXPECT_LE(after, before);
  EXPECT_GT(after, 0.98 * before);
}

TEST(Reinsertion, OddBoxes) {
  Random random(3);
  const std::vector<std::function<Box3(int)>> odd{
      [&](int) {
        return boxAt({}, {1, 1, 1});
      },
      [&](int) {
        return boxAt({2, 2, 2}, {});
      },
      [&](int i) {
        return boxAt({}, Vec3{1, 1, 1} * i);
      },
      [&](int i) {
        return boxAt({}, Vec3{1, 1, 1} * std::pow(10.0, i / 60.0 - 30));
      },
      [&](int i) {
        return boxAt(Vec3{1, 0, 0} * i, {0, 1, 0});
      },
      [&](int i) {
        return boxAt(Vec3{1, 1, 0} * i, {});
      },
      [&](int) { return boxAt(random.inCube(1), random.inCube(20)); },
      [&](int i) { return boxAt(random.inCube(1), random.inCube(i % 2 ? 20 : 1e-6)); }};
  for (const auto& box : odd)
    for (int count : {1, 2, 5, 6, 17, 3600}) {
      const auto [before, after] = reinserted(treeOf(count, box));
      if (std::isfinite(before)) {
        EXPECT_LE(after, before * (1 + 1e-6));
      }
    }
}

}  // namespace
}  // namespace trace::test
