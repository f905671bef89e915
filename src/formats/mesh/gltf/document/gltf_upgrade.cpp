// Sources: Khronos Group, glTF 1.0 Specification; its extensions KHR_binary_glTF and KHR_materials_common.
#include "formats/mesh/gltf/document/gltf_upgrade.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "image/srgb.h"

namespace trace {
namespace {

using nlohmann::json;

const json& member(const json& from, const char* key) {
  static const json kNothing;
  if (!from.is_object()) return kNothing;
  const auto found = from.find(key);
  return found == from.end() ? kNothing : *found;
}
const json& object(const json& from, const char* key) {
  static const json kEmpty = json::object();
  const json& value = member(from, key);
  return value.is_object() ? value : kEmpty;
}
double number(const json& from, const char* key, double otherwise) {
  const json& value = member(from, key);
  return value.is_number() ? value.get<double>() : otherwise;
}
std::uint64_t whole(const json& from, const char* key) {
  const json& value = member(from, key);
  return value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
}

void copy(const json& from, json& to, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (const json& value = member(from, key); !value.is_null()) to[key] = value;
}

/// The bytes of an element, 0 if its type is none.
std::uint64_t elementSize(const json& accessor) {
  const json& type = member(accessor, "type");
  std::uint64_t components = 0;
  for (const auto& [name, count] : {std::pair{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}})
    if (type == name) components = static_cast<std::uint64_t>(count);
  switch (whole(accessor, "componentType")) {
    case 5120:
    case 5121: return components;
    case 5122:
    case 5123: return components * 2;
    case 5125:
    case 5126: return components * 4;
    default: return 0;
  }
}

json linearColor(const json& color, std::size_t count) {
  json result = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = i < color.size() && color[i].is_number() ? color[i].get<double>() : 1;
    result.push_back(i < 3 ? linearOfSrgb(std::clamp(x, 0.0, 1.0)) : x);
  }
  return result;
}

class Upgrade {
 public:
  Upgrade(const json& root, const SourcePlace& place) : root_(root), place_(place) {}

  json whole2() {
    to_["asset"] = {{"version", "2.0"}};
    buffers();
    views();
    accessors();
    list("images", [&](const json& from) { return image(from); });
    list("samplers", [](const json& from) {
      json sampler = json::object();
      copy(from, sampler, {"magFilter", "minFilter", "wrapS", "wrapT"});
      return sampler;
    });
    list("textures", [&](const json& from) {
      json texture = json::object();
      link(from, texture, "sampler", "samplers");
      link(from, texture, "source", "images");
      return texture;
    });
    list("materials", [&](const json& from) { return material(from); });
    list("meshes", [&](const json& from) { return mesh(from); });
    list("cameras", [](const json& from) {
      json camera = json::object();
      copy(from, camera, {"name", "type", "perspective", "orthographic"});
      return camera;
    });
    list("nodes", [&](const json& from) { return node(from); });
    for (json& node : more_) to_["nodes"].push_back(std::move(node));
    list("scenes", [&](const json& from) {
      json scene = json::object();
      links(from, scene, "nodes", "nodes");
      return scene;
    });
    link(root_, to_, "scene", "scenes");
    if (!object(root_, "animations").empty()) to_["animations"] = json::array({animation()});
    return std::move(to_);
  }

 private:
  [[noreturn]] void fail(std::string what) const { throw Error(Fault::scene, place_, std::move(what)); }

  // --- names ---

  /// The number of the thing of that name in the list of version 2.
  std::size_t numberOf(const json& name, const char* kind) const {
    const json& all = object(root_, kind);
    const auto found = name.is_string() ? all.find(name.get<std::string>()) : all.end();
    if (found == all.end())
      fail("there is nothing called " +
           name.dump(-1, ' ', false, json::error_handler_t::replace).substr(0, 60) + " among the " + kind);
    const auto place = static_cast<std::size_t>(std::distance(all.begin(), found));
    return kind == std::string_view("buffers") ? orderOfBuffers_[place] : place;
  }
  void link(const json& from, json& to, const char* key, const char* kind) const {
    if (const json& name = member(from, key); !name.is_null()) to[key] = numberOf(name, kind);
  }
  void links(const json& from, json& to, const char* key, const char* kind) const {
    const json& names = member(from, key);
    if (!names.is_array() || names.empty()) return;
    for (const json& name : names) to[key].push_back(numberOf(name, kind));
  }

  template <class Make>
  void list(const char* kind, const Make& make) {
    for (const json& from : object(root_, kind)) to_[kind].push_back(make(from));
  }

  // --- bytes ---

  static bool isBody(const std::string& name) { return name == "binary_glTF" || name == "KHR_binary_glTF"; }

  /// The body of a binary file comes first, without a uri.
  void buffers() {
    const json& all = object(root_, "buffers");
    std::vector<json> first, others;
    for (const auto& [name, from] : all.items()) {
      json buffer = {{"byteLength", whole(from, "byteLength")}};
      if (!isBody(name)) copy(from, buffer, {"uri"});
      (isBody(name) ? first : others).push_back(std::move(buffer));
    }
    std::size_t body = 0, other = first.size();
    for (const auto& [name, from] : all.items()) orderOfBuffers_.push_back(isBody(name) ? body++ : other++);
    for (auto* part : {&first, &others})
      for (json& buffer : *part) to_["buffers"].push_back(std::move(buffer));
  }
  void views() {
    list("bufferViews", [&](const json& from) {
      json view = {{"buffer", numberOf(member(from, "buffer"), "buffers")}};
      copy(from, view, {"byteOffset", "byteLength"});
      return view;
    });
  }
  /// In version 1 the way from element to element is the accessor's: each that has one gets a view of its
  /// own.
  void accessors() {
    list("accessors", [&](const json& from) {
      json accessor = json::object();
      copy(from, accessor, {"byteOffset", "componentType", "count", "type", "min", "max"});
      const std::size_t view = numberOf(member(from, "bufferView"), "bufferViews");
      accessor["bufferView"] = view;
      const std::uint64_t stride = whole(from, "byteStride"), size = elementSize(from);
      if (stride == 0 || stride == size) return accessor;
      json own = to_["bufferViews"][view];
      own["byteStride"] = stride;
      accessor["bufferView"] = to_["bufferViews"].size();
      to_["bufferViews"].push_back(std::move(own));
      return accessor;
    });
  }
  json image(const json& from) {
    json result = json::object();
    copy(from, result, {"name"});
    const json& inside = object(object(from, "extensions"), "KHR_binary_glTF");
    if (inside.empty()) {
      copy(from, result, {"uri"});
    } else {
      link(inside, result, "bufferView", "bufferViews");
      copy(inside, result, {"mimeType"});
    }
    return result;
  }

  /// All as one: exporters made one for each thing that moves. A sampler names parameters, which name
  /// accessors.
  json animation() const {
    json samplers = json::array(), channels = json::array();
    for (const json& from : object(root_, "animations")) {
      const json &parameters = object(from, "parameters"), &list = member(from, "channels");
      for (const json& channel : list.is_array() ? list : json::array()) {
        const json &name = member(channel, "sampler"), &target = object(channel, "target");
        const json& old = name.is_string()
                              ? object(object(from, "samplers"), name.get_ref<const std::string&>().c_str())
                              : object({}, "");
        json sampler = json::object(), to = json::object();
        copy(old, sampler, {"interpolation"});
        for (const char* key : {"input", "output"})
          if (const json& parameter = member(old, key); parameter.is_string())
            sampler[key] =
                numberOf(member(parameters, parameter.get_ref<const std::string&>().c_str()), "accessors");
        copy(target, to, {"path"});
        if (const json& node = member(target, "id"); !node.is_null()) to["node"] = numberOf(node, "nodes");
        channels.push_back({{"sampler", samplers.size()}, {"target", std::move(to)}});
        samplers.push_back(std::move(sampler));
      }
    }
    return {{"samplers", std::move(samplers)}, {"channels", std::move(channels)}};
  }

  // --- looks ---

  json material(const json& from) {
    const json& common = object(object(from, "extensions"), "KHR_materials_common");
    const json& values = object(common.empty() ? from : common, "values");
    json result = json::object(), pbr = {{"metallicFactor", 0}};
    copy(from, result, {"name"});
    // The exponent whose lobe is as wide as that of the roughness (gltf_material.h).
    const double shininess = std::max(0.0, number(values, "shininess", 0));
    pbr["roughnessFactor"] = std::sqrt(std::sqrt(2 / (shininess + 2)));
    double alpha = std::clamp(number(values, "transparency", 1), 0.0, 1.0);
    if (const json& diffuse = member(values, "diffuse"); diffuse.is_string())
      pbr["baseColorTexture"] = {{"index", numberOf(diffuse, "textures")}};
    else if (diffuse.is_array()) {
      pbr["baseColorFactor"] = linearColor(diffuse, 4);
      alpha *= std::clamp(pbr["baseColorFactor"][3].get<double>(), 0.0, 1.0);
    }
    if (alpha < 1) {
      if (!pbr.contains("baseColorFactor")) pbr["baseColorFactor"] = {1, 1, 1, 1};
      pbr["baseColorFactor"][3] = alpha;
    }
    if (alpha < 1 || member(common, "transparent") == true) result["alphaMode"] = "BLEND";
    if (const json& emission = member(values, "emission"); emission.is_string()) {
      result["emissiveFactor"] = {1, 1, 1};
      result["emissiveTexture"] = {{"index", numberOf(emission, "textures")}};
    } else if (emission.is_array())
      result["emissiveFactor"] = linearColor(emission, 3);
    result["pbrMetallicRoughness"] = std::move(pbr);
    return result;
  }

  // --- meshes and nodes ---

  json mesh(const json& from) {
    json result = json::object();
    copy(from, result, {"name"});
    result["primitives"] = json::array();
    const json& primitives = member(from, "primitives");
    if (!primitives.is_array()) return result;
    for (const json& part : primitives) {
      json primitive = json::object();
      copy(part, primitive, {"mode"});
      primitive["attributes"] = json::object();
      for (const auto& [name, accessor] : object(part, "attributes").items())
        if (const char* known = attribute(name))
          primitive["attributes"][known] = numberOf(accessor, "accessors");
      link(part, primitive, "indices", "accessors");
      link(part, primitive, "material", "materials");
      result["primitives"].push_back(std::move(primitive));
    }
    return result;
  }
  static const char* attribute(const std::string& name) {
    if (name == "COLOR") return "COLOR_0";
    for (const char* known : {"POSITION", "NORMAL", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"})
      if (name == known) return known;
    return nullptr;
  }

  /// Where a node has several meshes, each but the first gets a node of its own below this one.
  json node(const json& from) {
    json result = json::object();
    copy(from, result, {"name"});
    copy(from, result, {"matrix", "translation", "rotation", "scale"});
    if (result.contains("matrix"))
      for (const char* key : {"translation", "rotation", "scale"}) result.erase(key);
    links(from, result, "children", "nodes");
    link(from, result, "camera", "cameras");
    const json& meshes = member(from, "meshes");
    if (!meshes.is_array() || meshes.empty()) return result;
    result["mesh"] = numberOf(meshes.front(), "meshes");
    for (std::size_t i = 1; i < meshes.size(); ++i) {
      result["children"].push_back(object(root_, "nodes").size() + more_.size());
      more_.push_back({{"mesh", numberOf(meshes[i], "meshes")}});
    }
    return result;
  }

  const json& root_;
  const SourcePlace& place_;
  json to_ = json::object();
  json more_ = json::array();  ///< nodes that the file does not have, behind its own
  std::vector<std::size_t> orderOfBuffers_;
};

void append(std::string& bytes, std::uint64_t number) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> 8 * i & 255);
}
void append(std::string& bytes, std::string_view chunk, std::string_view kind, char filler) {
  const std::size_t padding = (4 - chunk.size() % 4) % 4;
  append(bytes, chunk.size() + padding);
  bytes += kind;
  bytes += chunk;
  bytes.append(padding, filler);
}

}  // namespace

bool isGltf1(const json& root) {
  const json& version = member(object(root, "asset"), "version");
  const bool one = version.is_string()   ? version.get<std::string>().starts_with("1")
                   : version.is_number() ? version.get<double>() < 2
                                         : false;
  return one && (member(root, "accessors").is_object() || member(root, "nodes").is_object());
}

json upgradedGltf(const json& root, const SourcePlace& place) { return Upgrade(root, place).whole2(); }

std::string upgradedGltfFile(const json& upgraded, std::string_view bytes) {
  constexpr std::size_t kHeader = 20;
  const std::string text = upgraded.dump(-1, ' ', false, json::error_handler_t::replace);
  if (!bytes.starts_with("glTF") || bytes.size() < kHeader) return text;
  const auto numberAt = [&](std::size_t at) {
    std::uint64_t number = 0;
    for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
  };
  std::string_view body = bytes.substr(std::min<std::uint64_t>(bytes.size(), kHeader + numberAt(12)));
  constexpr std::size_t kChunkHead = 8;  // its length and kind, in version 2
  if (numberAt(4) > 1 && body.size() >= kChunkHead)
    body = body.substr(kChunkHead, numberAt(bytes.size() - body.size()));
  std::string chunks;
  append(chunks, text, "JSON", ' ');
  append(chunks, body, std::string_view("BIN\0", 4), '\0');
  std::string file = "glTF";
  append(file, 2);
  append(file, 12 + chunks.size());
  return file + chunks;
}

}  // namespace trace
