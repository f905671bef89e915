#include "formats/mesh/gltf/document/gltf_unused.h"

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/mesh/gltf/gltf_unpack.h"

namespace trace {
namespace {

using nlohmann::json;

/// A list of the file, the keys by which others name its elements, and an element that says nothing.
struct GltfList {
  std::string_view name;
  std::array<std::string_view, 5> keys;
  std::string_view nothing;
};
constexpr std::array<GltfList, 11> kLists{{
    {"nodes", {"children", "nodes", "joints"}, "{}"},
    {"meshes", {"mesh"}, R"({"primitives": []})"},
    {"skins", {"skin"}, "{}"},
    {"cameras", {"camera"}, R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 1}})"},
    {"materials", {"material"}, "{}"},
    {"accessors",
     {"indices", "attribute", "inverseBindMatrices", "input", "output"},
     R"({"componentType": 5126, "count": 1, "type": "SCALAR"})"},
    {"textures", {"index"}, "{}"},
    {"images", {"source"}, R"({"uri": "data:image/png;base64,AA=="})"},
    {"samplers", {"sampler"}, "{}"},
    {"bufferViews", {"bufferView"}, R"({"buffer": 0, "byteLength": 1})"},
    {"buffers", {"buffer"}, R"({"byteLength": 1, "uri": "data:application/octet-stream;base64,AA=="})"},
}};

/// Follows the scene to what it uses. Without recursion over elements: a file may be one long chain.
class UseWalk {
 public:
  explicit UseWalk(const json& root) : root_(root) {}

  const std::map<std::string_view, std::set<std::size_t>>& walk() {
    const auto scenes = root_.find("scenes");
    if (scenes == root_.end() || !scenes->is_array() || scenes->empty()) {
      useAll("nodes");
    } else {
      const auto chosen = root_.find("scene");
      const std::size_t scene =
          chosen != root_.end() && chosen->is_number_unsigned() ? chosen->get<std::size_t>() : 0;
      if (scene < scenes->size()) look((*scenes)[scene], "");
    }
    if (const auto animations = root_.find("animations"); animations != root_.end()) look(*animations, "");
    while (!waiting_.empty()) {
      const auto [list, index] = waiting_.back();
      waiting_.pop_back();
      look((*root_.find(list))[index], "");
    }
    return used_;
  }

 private:
  void useAll(std::string_view name) {
    const auto list = root_.find(name);
    if (list == root_.end() || !list->is_array()) return;
    for (std::size_t i = 0; i < list->size(); ++i) use(name, i);
  }

  void use(std::string_view name, std::size_t index) {
    const auto list = root_.find(name);
    if (list == root_.end() || !list->is_array() || index >= list->size()) return;
    if (used_[name].insert(index).second) waiting_.emplace_back(name, index);
  }

  /// Uses what the value names, which stands behind the key.
  void look(const json& value, std::string_view key) {
    if (value.is_number_unsigned()) {
      for (const GltfList& list : kLists)
        for (std::string_view by : list.keys)
          if (!by.empty() && by == key) use(list.name, value.get<std::size_t>());
    } else if (value.is_array()) {
      for (const json& one : value) look(one, key);
    } else if (value.is_object()) {
      const bool isAttributes = key == "attributes" || key == "targets";
      for (const auto& [name, one] : value.items())
        if (name == kGltfDraco)  // its attributes are numbered apart
          look(one.is_object() ? one.value("bufferView", json()) : json(), "bufferView");
        else if (name != "extras")
          look(one, isAttributes ? "attribute" : std::string_view(name));
    }
  }

  const json& root_;
  std::map<std::string_view, std::set<std::size_t>> used_;
  std::vector<std::pair<std::string_view, std::size_t>> waiting_;
};

}  // namespace

std::size_t dropUnusedGltf(json& root) {
  const auto used = UseWalk(root).walk();
  std::size_t dropped = 0;
  for (const GltfList& list : kLists) {
    const auto found = root.find(list.name);
    if (found == root.end() || !found->is_array()) continue;
    const auto of = used.find(list.name);
    for (std::size_t i = 0; i < found->size(); ++i) {
      if (of != used.end() && of->second.contains(i)) continue;
      // The first buffer may be the body of a binary file.
      if (list.name == "buffers" && i == 0) continue;
      (*found)[i] = json::parse(list.nothing);
      ++dropped;
    }
  }
  return dropped;
}

}  // namespace trace
