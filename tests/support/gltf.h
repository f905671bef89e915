// glTF files with pictures in them: one square for each, side by side.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/base64.h"
#include "image/codecs/codec.h"
#include "shading/textures/image_map.h"

namespace trace::test {

/// A PNG file of 2 * 2 pixels, in rows from the top: the colour, white; black, grey.
inline std::string smallPng(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  Raster raster(2, 2, 3, 255);
  raster.samples = std::vector<std::uint8_t>{red, green, blue, 255, 255, 255, 0, 0, 0, 128, 128, 128};
  return encodePng(raster);
}

/// As GLB, with the pictures in its buffer, or as text, with data URIs.
inline std::string gltfOf(const std::vector<InsideFile>& pictures, bool binary) {
  const auto little = [](std::size_t n) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(n >> (8 * i) & 255);
    return bytes;
  };
  const auto padded = [](std::string bytes, char with) {
    while (bytes.size() % 4 != 0) bytes += with;
    return bytes;
  };
  const float numbers[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0,  // corners of two triangles
                           0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0};                   // and their uv
  std::string data(reinterpret_cast<const char*>(numbers), sizeof numbers);
  std::string views = R"({"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 48})";
  std::string images, textures, materials, meshes, nodes, roots;
  const auto add = [](std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ", ") + item;
  };
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto& [name, bytes] = pictures[i];
    const std::string n = std::to_string(i);
    const std::string named = name.empty() ? "" : "\"name\": \"" + name + "\", ";
    if (binary) {
      add(views, "{\"buffer\": 0, \"byteOffset\": " + std::to_string(data.size()) +
                     ", \"byteLength\": " + std::to_string(bytes.size()) + "}");
      add(images,
          "{" + named + "\"mimeType\": \"image/png\", \"bufferView\": " + std::to_string(i + 2) + "}");
      data = padded(data + bytes, '\0');
    } else {
      add(images, "{" + named + "\"uri\": \"data:image/png;base64," + toBase64(bytes) + "\"}");
    }
    add(textures, "{\"source\": " + n + "}");
    add(materials,
        R"({"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": )" + n + "}}}");
    add(meshes,
        R"({"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": )" + n + "}]}");
    add(nodes, "{\"mesh\": " + n + ", \"translation\": [" + std::to_string(1.25 * static_cast<double>(i)) +
                   ", 0, 0]}");
    add(roots, n);
  }
  const std::string uri =
      binary ? "" : R"("uri": "data:application/octet-stream;base64,)" + toBase64(data) + "\", ";
  const std::string json =
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + roots + R"(]}], "nodes": [)" +
      nodes + R"(], "meshes": [)" + meshes + R"(], "materials": [)" + materials + R"(], "textures": [)" +
      textures + R"(], "images": [)" + images + R"(], "accessors": [)" +
      R"({"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}, )" +
      R"({"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"}], "bufferViews": [)" + views +
      R"(], "buffers": [{)" + uri + "\"byteLength\": " + std::to_string(data.size()) + "}]}";
  if (!binary) return json;
  const std::string text = padded(json, ' ');
  return "glTF" + little(2) + little(12 + 8 + text.size() + 8 + data.size()) + little(text.size()) + "JSON" +
         text + little(data.size()) + std::string("BIN\0", 4) + data;
}

}  // namespace trace::test
