// Models with small pictures on them, and what is read of them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/files/file.h"
#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "image/maps/mipmap.h"
#include "image/srgb.h"
#include "shading/materials/principled.h"
#include "shading/optics/microfacet.h"
#include "support/folder.h"

namespace trace::test {

inline const Color kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1), kWhite(1);

/// A Truevision file of 2 * 2 pixels, in rows from the top: red, green; blue, white. With alpha each pixel
/// has one of its own: 255, 0; 128, 51.
inline std::string picture(bool alpha = false, std::string_view pixels = {}) {
  std::string file{
      0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, char(alpha ? 32 : 24), char(alpha ? 0x28 : 0x20)};
  const unsigned char bgra[4][4] = {{0, 0, 255, 255}, {0, 255, 0, 0}, {255, 0, 0, 128}, {255, 255, 255, 51}};
  for (const auto& pixel : bgra)
    for (int c = 0; c < (alpha ? 4 : 3); ++c) file += static_cast<char>(pixel[c]);
  return pixels.empty() ? file : file.substr(0, 18) + std::string(pixels);
}

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

struct Read {
  Messages messages;
  Scene scene;

  Read(const std::string& file, const std::string& text) : scene(readScene(file, text, messages)) {}
  const Material& material(std::size_t object = 0) const {
    return scene.materials.at(scene.objects.at(object).material);
  }
  const MeshData& mesh(std::size_t object = 0) const {
    return *scene.objects.at(object).shape.as<Mesh>()->data;
  }
  const Texture& texture(std::string_view field, std::size_t object = 0) const {
    const Texture* texture = textureOf(material(object).textures, field);
    if (!texture) throw std::runtime_error("no texture of " + std::string(field));
    return *texture;
  }
  Color at(std::string_view field, const Vec2& uv, std::size_t object = 0) const {
    return texture(field, object)
        .at({.point = {}, .uv = uv, .uvX = {}, .uvY = {}, .pointX = {}, .pointY = {}});
  }
  /// How much of the surface is there at a place.
  Real opacityAt(const Vec2& uv, std::size_t object = 0) const {
    const Real even = material(object).opacity;
    return textureOf(material(object).textures, kOpacity) ? even * luminance(at(kOpacity, uv, object)) : even;
  }
  /// The field at a place, its constant and its texture.
  Phong phongAt(const Vec2& uv, std::size_t object = 0) const {
    Phong phong = *material(object).model.as<Phong>();
    applyTextures(phong, material(object).textures,
                  {.point = {}, .uv = uv, .uvX = {}, .uvY = {}, .pointX = {}, .pointY = {}});
    return phong;
  }
  std::string warnings() const {
    std::string all;
    for (const Message& message : messages.all())
      if (!message.what.starts_with("no light")) all += message.what + "\n";
    return all;
  }
};

inline constexpr Vec2 kTopLeft{0.25, 0.75}, kTopRight{0.75, 0.75}, kBottomLeft{0.25, 0.25},
    kBottomRight{0.75, 0.25};

inline void expectUpright(const Read& read, std::string_view field, std::size_t object = 0) {
  EXPECT_EQ(read.at(field, kTopLeft, object), kRed);
  EXPECT_EQ(read.at(field, kTopRight, object), kGreen);
  EXPECT_EQ(read.at(field, kBottomLeft, object), kBlue);
  EXPECT_EQ(read.at(field, kBottomRight, object), kWhite);
}

// --- glTF

/// A triangle with texture coordinates (0, 0), (1, 0), (0, 1), and the picture behind its numbers.
inline std::string gltf(const std::string& material, const std::string& texture = "\"source\": 0",
                        const std::string& more = "", const std::string& bytes = picture()) {
  const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
  std::string data(reinterpret_cast<const char*>(numbers), sizeof numbers);
  data += bytes;
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
{"buffer": 0, "byteOffset": 60, "byteLength": )" +
         std::to_string(bytes.size()) + R"(}], "buffers": [{"byteLength": )" + std::to_string(data.size()) +
         R"(, "uri": "data:application/octet-stream;base64,)" + base64(data) + R"("}],
"images": [{"bufferView": 2, "mimeType": "image/tga"}], "textures": [{)" +
         texture + "}], " + more + "\"materials\": [{" + material + "}]}";
}
inline const std::string kBase = R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}})";

/// A material with that extension, whose base has the further properties.
inline Read extended(const std::string& extension, const std::string& fields, const std::string& base = "",
                     const std::string& bytes = picture(), const std::string& also = "") {
  return {"a.gltf", gltf("\"pbrMetallicRoughness\": {" + base + "}, \"extensions\": {\"" + extension +
                             "\": {" + fields + "}" + also + "}",
                         "\"source\": 0", "", bytes)};
}
inline const Principled& principledOf(const Read& read) { return *read.material().model.as<Principled>(); }

}  // namespace trace::test
