#include "formats/mesh/gltf/document/gltf_tree.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace trace {
namespace {

[[noreturn]] void fail(const SourcePlace& place, std::size_t node, std::size_t parent) {
  const auto name = [](std::size_t number) { return "nodes[" + std::to_string(number) + "]"; };
  throw Error(Fault::scene, place,
              name(node) + ": " +
                  (node == parent ? "it is its own child"
                                  : "it stands below itself: it is a child of " + name(parent) +
                                        ", which stands below it"));
}

}  // namespace

void checkGltfTree(const nlohmann::json& root, const SourcePlace& place) {
  const auto nodes = root.find("nodes");
  if (nodes == root.end()) return;
  enum class Seen : char { no, open, done };
  std::vector<Seen> seen(nodes->size(), Seen::no);
  struct Step {
    std::size_t node, next;  ///< the next of its children
  };
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first] != Seen::no) continue;
    std::vector<Step> path{{first, 0}};  // all of it is open
    seen[first] = Seen::open;
    while (!path.empty()) {
      const std::size_t node = path.back().node;
      const auto children = (*nodes)[node].find("children");
      if (children == (*nodes)[node].end() || path.back().next == children->size()) {
        seen[node] = Seen::done;
        path.pop_back();
        continue;
      }
      const auto child = (*children)[path.back().next++].get<std::size_t>();
      if (seen[child] == Seen::open) fail(place, child, node);
      if (seen[child] == Seen::no) {
        seen[child] = Seen::open;
        path.push_back({child, 0});
      }
    }
  }
}

}  // namespace trace
