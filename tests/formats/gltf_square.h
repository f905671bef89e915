// A glTF file of one square, for tests that change it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/base64.h"
#include "support/gltf.h"

namespace trace::test {

using nlohmann::json;

/// A square with a textured material, which grows by accessors.
class Square {
 public:
  Square() {
    root = json::parse(
        R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {}, "material": 0}]}],
      "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.5, "roughnessFactor": 0.5}}],
      "textures": [{"source": 0}, {"source": 1}], "images": [], "accessors": [], "bufferViews": []})");
    for (int blue : {0, 255})
      root["images"].push_back(
          {{"uri",
            "data:image/png;base64," + toBase64(test::smallPng(255, 0, static_cast<std::uint8_t>(blue)))}});
    attribute("POSITION", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
    attribute("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    attribute("TEXCOORD_0", {0, 0, 1, 0, 1, 1, 0, 1}, 2);
    primitive()["indices"] = bytes(std::string("\0\1\2\0\2\3", 6), 5121, 6, "SCALAR");
  }

  json& primitive() { return root["meshes"][0]["primitives"][0]; }
  json& material() { return root["materials"][0]; }
  json& node() { return root["nodes"][0]; }
  json& camera(const char* type, json values) {
    root["cameras"] = {{{"type", type}, {type, std::move(values)}}};
    node()["camera"] = 0;
    return root["cameras"][0][type];
  }

  /// The number of a new accessor.
  int bytes(const std::string& data, int componentType, int count, const char* type) {
    while (data_.size() % 4 != 0) data_ += '\0';
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", data.size()}});
    data_ += data;
    root["accessors"].push_back({{"bufferView", root["bufferViews"].size() - 1},
                                 {"componentType", componentType},
                                 {"count", count},
                                 {"type", type}});
    return static_cast<int>(root["accessors"].size()) - 1;
  }
  int floats(const std::vector<float>& numbers, int each) {
    const char* const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return bytes(std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)),
                 5126, static_cast<int>(numbers.size()) / each, types[each - 1]);
  }
  int matrices(const std::vector<float>& numbers) {
    return bytes(std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)),
                 5126, static_cast<int>(numbers.size()) / 16, "MAT4");
  }
  Square& attribute(const std::string& name, const std::vector<float>& numbers, int each) {
    primitive()["attributes"][name] = floats(numbers, each);
    return *this;
  }
  /// Sets the value at a pointer such as /materials/0/name.
  Square& set(const std::string& at, json value) {
    root[json::json_pointer(at)] = std::move(value);
    return *this;
  }
  Square& erase(const std::string& at) {
    const json::json_pointer pointer(at);
    root[pointer.parent_pointer()].erase(pointer.back());
    return *this;
  }

  std::string text() const {
    json whole = root;
    if (!whole.contains("buffers")) whole["buffers"] = {{{"byteLength", data_.size()}}};
    json& buffer = whole["buffers"][0];
    if (!buffer.contains("uri")) buffer["uri"] = "data:application/octet-stream;base64," + toBase64(data_);
    return whole.dump();
  }
  std::string glb() const {
    const auto little = [](std::size_t n) {
      std::string four;
      for (int i = 0; i < 4; ++i) four += static_cast<char>(n >> (8 * i) & 255);
      return four;
    };
    json whole = root;
    std::string data = data_;
    while (data.size() % 4 != 0) data += '\0';
    whole["buffers"] = {{{"byteLength", data.size()}}};
    std::string head = whole.dump();
    while (head.size() % 4 != 0) head += ' ';
    return "glTF" + little(2) + little(28 + head.size() + data.size()) + little(head.size()) + "JSON" + head +
           little(data.size()) + std::string("BIN\0", 4) + data;
  }
  const std::string& data() const { return data_; }

  json root;

 private:
  std::string data_;
};

}  // namespace trace::test
