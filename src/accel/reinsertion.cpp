#include "accel/reinsertion.h"

#include <algorithm>

#include "accel/bvh_node.h"

namespace trace {
namespace {

// Large branches come first, then smaller ones too: these are their shares of the whole's area.
constexpr float kShares[] = {1e-2f, 1e-3f, 3e-4f};
constexpr double kPays = 0.99;  // on only if no more than this is left of the inner boxes' areas

// Where many large boxes lie in one place a search would go through them all: so it costs 70 ms at most.
constexpr std::size_t kMostNodes = 1 << 14;
constexpr int kMostLooks = 100;  // for one new place

/// The large branches of a tree, and their smaller children as its leaves. As in the tree, siblings lie side
/// by side: at places 2 i and 2 i + 1. The root has place 0, and place 1 is empty.
class Top {
 public:
  /// Branches of at least that area. No item of the tree lies deeper than `depth`.
  Top(std::vector<Branch>& tree, float smallest, int depth) : tree_(tree), smallest_(smallest) {
    add(tree[0], depth);
    add({}, 0);
    addPair(0, 0);
    for (std::uint32_t i = 0; i < nodes_.size() && nodes_.size() < kMostNodes; ++i) {
      const Branch b = original_[i];
      if (i == 1 || b.count > 0 || area(i) < smallest) continue;
      nodes_[i].first = static_cast<std::uint32_t>(nodes_.size());
      nodes_[i].count = 0;
      addPair(i, b.first);
      for (std::uint32_t child : {b.first, b.first + 1}) add(tree[child], heights_[i] - 1);
    }
  }

  void reinsertAll() {
    for (std::uint32_t i = 2; i < nodes_.size(); ++i)
      if (area(i) >= smallest_) reinsert(i);
  }

  /// Puts the branches back into the tree, where they find room.
  void write() const {
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (i == 1) continue;
      Branch& b = tree_[pairs_[i / 2] + i % 2];
      if (inner(i)) {
        b = nodes_[i];
        b.first = pairs_[b.first / 2];
      } else {
        b = original_[nodes_[i].first];
      }
    }
  }

  /// The area of all inner boxes, which rays pay for.
  double innerArea() const {
    double sum = 0;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (i != 1 && inner(i)) sum += double{area(i)};
    return sum;
  }
  /// No item lies deeper now.
  int depth() const { return heights_[0]; }

 private:
  bool inner(std::uint32_t place) const { return nodes_[place].count == 0; }
  float area(std::uint32_t place) const { return boxOf(nodes_[place]).halfArea(); }

  void add(const Branch& branch, int height) {
    Branch leaf = branch;
    leaf.first = static_cast<std::uint32_t>(nodes_.size());
    leaf.count = 1;
    nodes_.push_back(leaf);
    original_.push_back(branch);
    heights_.push_back(height);
  }
  void addPair(std::uint32_t parent, std::uint32_t place) {
    parents_.push_back(parent);
    pairs_.push_back(place);
  }

  void reinsert(std::uint32_t place) {
    const std::uint32_t parent = parents_[place / 2], pair = place - place % 2;
    const Branch branch = nodes_[place];
    const int height = heights_[place];
    float spared = area(parent);
    put(parent, nodes_[place ^ 1], heights_[place ^ 1]);  // the sibling takes their parent's place
    if (parent != 0) spared += fit(parents_[parent / 2]);
    const std::uint32_t sibling = bestSibling(boxOf(branch), height, spared, parent);
    put(pair, nodes_[sibling], heights_[sibling]);
    put(pair + 1, branch, height);
    nodes_[sibling].first = pair;
    nodes_[sibling].count = 0;
    parents_[pair / 2] = sibling;
    fit(sibling);
  }

  void put(std::uint32_t place, const Branch& branch, int height) {
    nodes_[place] = branch;
    heights_[place] = height;
    if (branch.count == 0) parents_[branch.first / 2] = place;
  }

  /// Boxes and heights from an inner node up, as far as they change; returns how much area they lose.
  float fit(std::uint32_t place) {
    float lost = 0;
    for (;; place = parents_[place / 2]) {
      Branch& node = nodes_[place];
      const Bounds before = boxOf(node);
      Bounds box = boxOf(nodes_[node.first]);
      box.extend(boxOf(nodes_[node.first + 1]));
      const int height = 1 + std::max(heights_[node.first], heights_[node.first + 1]);
      if (box.inside(before) && before.inside(box) && height == heights_[place]) return lost;
      lost += before.halfArea() - box.halfArea();
      set(node, box, node.first, 0);
      heights_[place] = height;
      if (place == 0) return lost;
    }
  }

  /// Where inner boxes grow by the least, and by less than `most`, if a branch of that box is put beside what
  /// is there; `otherwise` if there is no such place.
  std::uint32_t bestSibling(const Bounds& box, int height, float most, std::uint32_t otherwise) {
    std::uint32_t best = otherwise;
    const float own = box.halfArea();
    waiting_.assign(1, {0, 0, 0});
    for (int looks = 0; !waiting_.empty() && looks < kMostLooks; ++looks) {
      const Waiting& next = waiting_.back();  // one by one, as they were written: a copy would wait for them
      const float grown = next.grown;
      const std::uint32_t place = next.place;
      const int depth = next.depth;
      waiting_.pop_back();
      if (!(grown + own < most)) continue;
      Bounds both = boxOf(nodes_[place]);
      both.extend(box);
      const float beside = grown + both.halfArea(), below = beside - area(place);
      if (beside < most && depth + 1 + std::max(height, heights_[place]) <= BvhNode::kMostDepth) {
        most = beside;
        best = place;
      }
      if (inner(place) && below + own < most)
        for (std::uint32_t child = 0; child < 2; ++child)
          waiting_.push_back({below, nodes_[place].first + child, depth + 1});
    }
    return best;
  }

  struct Waiting {
    float grown;  ///< by how much all boxes above do
    std::uint32_t place;
    int depth;
  };

  std::vector<Branch>& tree_;
  const float smallest_;
  std::vector<Branch> nodes_;     ///< `first` of a leaf is the place where it was at first; its count is 1
  std::vector<Branch> original_;  ///< those that were there at first
  std::vector<int> heights_;      ///< how far below each the deepest item lies, at most
  std::vector<std::uint32_t> parents_;  ///< parents of pairs
  std::vector<std::uint32_t> pairs_;    ///< where they lie in the tree
  std::vector<Waiting> waiting_;        // kept to save allocations
};

}  // namespace

void reinsertLargeBranches(std::vector<Branch>& tree) {
  const float whole = boxOf(tree[0]).halfArea();
  int depth = kMostDepthBuilt;
  for (float share : kShares) {
    Top top(tree, whole * share, depth);
    const double before = top.innerArea();
    top.reinsertAll();
    top.write();
    depth = top.depth();
    if (!(top.innerArea() <= kPays * before)) return;
  }
}

}  // namespace trace
