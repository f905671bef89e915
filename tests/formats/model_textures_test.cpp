// What the textures of models become: exact texels, by the texture coordinates of their meshes.
#include "formats/model_textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "image/mipmap.h"
#include "image/srgb.h"
#include "shading/microfacet.h"
#include "support/folder.h"

namespace trace::model_textures_test {
namespace {

const Color kRed(1, 0, 0), kGreen(0, 1, 0), kBlue(0, 0, 1), kWhite(1);

/// A Truevision file of 2 * 2 pixels, in rows from the top: red, green; blue, white. With alpha each pixel
/// has one of its own: 255, 0; 128, 51.
std::string picture(bool alpha = false, std::string_view pixels = {}) {
  std::string file{
      0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, char(alpha ? 32 : 24), char(alpha ? 0x28 : 0x20)};
  const unsigned char bgra[4][4] = {{0, 0, 255, 255}, {0, 255, 0, 0}, {255, 0, 0, 128}, {255, 255, 255, 51}};
  for (const auto& pixel : bgra)
    for (int c = 0; c < (alpha ? 4 : 3); ++c) file += static_cast<char>(pixel[c]);
  return pixels.empty() ? file : file.substr(0, 18) + std::string(pixels);
}

std::string base64(std::string_view bytes) {
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
  /// The field at a place, its constant and its texture.
  Phong phongAt(const Vec2& uv, std::size_t object = 0) const {
    Phong phong = std::get<Phong>(material(object).model);
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

constexpr Vec2 kTopLeft{0.25, 0.75}, kTopRight{0.75, 0.75}, kBottomLeft{0.25, 0.25}, kBottomRight{0.75, 0.25};

void expectUpright(const Read& read, std::string_view field, std::size_t object = 0) {
  EXPECT_EQ(read.at(field, kTopLeft, object), kRed);
  EXPECT_EQ(read.at(field, kTopRight, object), kGreen);
  EXPECT_EQ(read.at(field, kBottomLeft, object), kBlue);
  EXPECT_EQ(read.at(field, kBottomRight, object), kWhite);
}

// --- glTF ---------------------------------------------------------------------------------------------

/// A triangle with texture coordinates (0, 0), (1, 0), (0, 1), and the picture behind its numbers.
std::string gltf(const std::string& material, const std::string& texture = "\"source\": 0",
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
const std::string kBase = R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}})";

TEST(GltfTextures, PicturesInsideTheFileStandUpright) {
  const Read read("a.gltf", gltf(kBase));
  EXPECT_EQ(read.warnings(), "");
  EXPECT_TRUE(std::holds_alternative<Principled>(read.material().model));
  expectUpright(read, "color");
  expectUpright(read, "ambient");
  EXPECT_EQ(read.mesh().uvs, (std::vector<Vec2>{{0, 1}, {1, 1}, {0, 0}})) << "(0, 0) is the top left corner";
}

TEST(GltfTextures, PicturesAreFilesOrTextToo) {
  const test::Folder folder;
  writeFile(folder / "a b.tga", picture());
  const auto with = [&](const std::string& image) {
    std::string text = gltf(kBase);
    const std::string own = R"("bufferView": 2, "mimeType": "image/tga")";
    text.replace(text.find(own), own.size(), image);
    return Read(folder / "a.gltf", text);
  };
  expectUpright(with(R"("uri": "a%20b.tga")"), "color");
  expectUpright(with("\"uri\": \"data:image/png;base64," + base64(picture()) + "\""), "color");
}

TEST(GltfTextures, ColoursAreDecoded) {
  const std::string grey = picture(false, std::string(12, char(188)));
  const Read read("a.gltf", gltf(R"("emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0},
"occlusionTexture": {"index": 0, "strength": 0.5}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
"metallicRoughnessTexture": {"index": 0}})",
                                 "\"source\": 0", "", grey));
  const Real level = 188 / 255.0;
  EXPECT_NEAR(read.at("color", kTopLeft).r, linearOfSrgb(level), 1e-6);
  EXPECT_NEAR(read.at("emissive", kTopLeft).r, linearOfSrgb(level), 1e-6);
  EXPECT_NEAR(read.at("roughness", kTopLeft).r, level, 1e-6) << "numbers are numbers";
  EXPECT_NEAR(read.at("ambient", kTopLeft).r, linearOfSrgb(level) * (0.5 + 0.5 * level), 1e-6);
}

TEST(GltfTextures, ChannelsOfMetallicRoughnessAndOcclusion) {
  const Read read("a.gltf", gltf(R"("occlusionTexture": {"index": 0},
"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}})"));
  for (const auto& [place, channels] :
       {std::pair{kTopLeft, kRed}, {kTopRight, kGreen}, {kBottomLeft, kBlue}}) {
    EXPECT_EQ(read.at("ambient", place).r, channels.r);
    EXPECT_EQ(read.at("roughness", place).r, channels.g);
    EXPECT_EQ(read.at("metallic", place).r, channels.b);
  }
}

TEST(GltfTextures, NormalsBendTheNormal) {
  const Read read("a.gltf", gltf(R"("normalTexture": {"index": 0, "scale": 0.5})"));
  const auto& map = std::get<ImageMap>(read.texture("bump")->model);
  EXPECT_EQ(map.relief, Relief::normals) << "green counts up";
  EXPECT_FALSE(map.srgb);
  EXPECT_EQ(read.material().bump, 0.5);
  expectUpright(read, "bump");
}

TEST(GltfTextures, SamplersAndTransforms) {
  const std::string sampler = "\"samplers\": [{\"wrapS\": 33071, \"wrapT\": 33648, \"magFilter\": 9728}], ";
  const Read wrapped("a.gltf", gltf(kBase, R"("source": 0, "sampler": 0)", sampler));
  EXPECT_EQ(wrapped.at("color", {1.25, 0.75}), kGreen) << "clamped";
  EXPECT_EQ(wrapped.at("color", {0.25, 1.25}), kRed) << "mirrored";
  EXPECT_EQ(wrapped.at("color", {0.49, 0.75}), kRed) << "nearest";

  const auto moved = [&](const std::string& transform) {
    return Read("a.gltf", gltf(R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
"extensions": {"KHR_texture_transform": {)" +
                               transform + "}}}}"));
  };
  EXPECT_EQ(moved("\"offset\": [0.5, 0]").at("color", kTopLeft), kGreen);
  EXPECT_EQ(moved("\"offset\": [0, 0.5]").at("color", kTopLeft), kBlue) << "v grows downward";
  // Scaled from the top left corner: the place (0.375, 0.125) of glTF becomes (0.75, 0.25).
  EXPECT_EQ(moved("\"scale\": [2, 2]").at("color", {0.375, 0.875}), kGreen);
  // The texture coordinates are turned counter-clockwise: what was on the right is above, one picture higher.
  EXPECT_EQ(moved("\"rotation\": 1.5707963267948966").at("color", kTopLeft), kBlue);
  EXPECT_EQ(moved("\"rotation\": 1.5707963267948966").at("color", kTopRight), kRed);
}

TEST(GltfTextures, AlphaMakesHoles) {
  const auto with = [](const std::string& mode, double factor) {
    return Read("a.gltf",
                gltf("\"alphaMode\": \"" + mode + R"(", "pbrMetallicRoughness": {"metallicFactor": 0,
"baseColorFactor": [1, 1, 1, )" +
                         std::to_string(factor) + R"(], "baseColorTexture": {"index": 0}})",
                     "\"source\": 0", "", picture(true)));
  };
  const Read blend = with("BLEND", 0.5);
  EXPECT_NEAR(blend.phongAt(kTopLeft).transmissive.g, 0.5, 1e-9);
  EXPECT_NEAR(blend.phongAt(kTopLeft).diffuse.r, 0.5, 1e-9);
  EXPECT_EQ(blend.phongAt(kTopRight).transmissive, kWhite);
  EXPECT_EQ(blend.phongAt(kTopRight).diffuse, Color(0));
  EXPECT_NEAR(blend.phongAt(kBottomRight).transmissive.r, 1 - 0.5 * 51 / 255, 1e-9);
  const Read mask = with("MASK", 1);  // the cutoff is 0.5
  EXPECT_EQ(mask.phongAt(kTopLeft).transmissive, Color(0));
  EXPECT_EQ(mask.phongAt(kBottomLeft).diffuse, kBlue) << "128 of 255 are enough";
  EXPECT_EQ(mask.phongAt(kBottomRight).transmissive, kWhite);
  EXPECT_TRUE(std::holds_alternative<Principled>(with("OPAQUE", 0.5).material().model));
}

TEST(GltfTextures, HolesKeepMetalnessAndRoughness) {
  const auto with = [](const std::string& mode) {
    return Read("a.gltf", gltf("\"alphaMode\": \"" + mode +
                                   R"(", "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0},
"baseColorFactor": [1, 1, 1, 0.5], "baseColorTexture": {"index": 0}})",
                               "\"source\": 0", "", picture(true)));
  };
  const Read blend = with("BLEND"), mask = with("MASK");
  for (const Read* read : {&blend, &mask}) {
    EXPECT_TRUE(std::holds_alternative<Principled>(read->material().model));
    EXPECT_EQ(read->at("metallic", kBottomLeft), Color(1)) << "blue";
    EXPECT_EQ(read->warnings(), "");
  }
  EXPECT_EQ(blend.material().opacity, 0.5);
  EXPECT_EQ(blend.at("opacity", kTopLeft), Color(1));
  EXPECT_EQ(blend.at("opacity", kTopRight), Color(0));
  EXPECT_NEAR(blend.at("opacity", kBottomRight).g, 51 / 255.0, 1e-9);
  EXPECT_EQ(mask.material().opacity, 1);
  EXPECT_EQ(mask.at("opacity", kTopLeft), Color(1)) << "1 times 0.5 is the cutoff";
  EXPECT_EQ(mask.at("opacity", kBottomRight), Color(0));
}

TEST(GltfTextures, IridescenceIsAFilm) {
  const Read read("a.gltf", gltf(R"("extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 0.7,
"iridescenceIor": 1.4, "iridescenceThicknessMinimum": 100, "iridescenceThicknessMaximum": 500,
"iridescenceThicknessTexture": {"index": 0}}})",
                                 "\"source\": 0"));
  EXPECT_EQ(read.warnings(), "");
  const auto& model = std::get<Principled>(read.material().model);
  EXPECT_EQ(model.iridescence, 0.7);
  EXPECT_EQ(model.iridescenceIndex, 1.4);
  EXPECT_EQ(model.iridescenceThickness, 500);
  EXPECT_NEAR(read.at("iridescence_thickness", kTopLeft).g, 0.2, 1e-12) << "no green";
  EXPECT_NEAR(read.at("iridescence_thickness", kTopRight).g, 1, 1e-12);
  const Read glass("a.gltf", gltf(R"("extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
"KHR_materials_iridescence": {"iridescenceFactor": 1}})"));
  EXPECT_NE(glass.warnings().find("its iridescence is not rendered"), std::string::npos);
}

/// A material with that extension, whose base has the further properties.
Read extended(const std::string& extension, const std::string& fields, const std::string& base = "",
              const std::string& bytes = picture(), const std::string& also = "") {
  return {"a.gltf", gltf("\"pbrMetallicRoughness\": {" + base + "}, \"extensions\": {\"" + extension +
                             "\": {" + fields + "}" + also + "}",
                         "\"source\": 0", "", bytes)};
}
const Principled& principledOf(const Read& read) { return std::get<Principled>(read.material().model); }

TEST(GltfExtensions, ClearCoat) {
  const Read read = extended("KHR_materials_clearcoat",
                             R"("clearcoatFactor": 0.8, "clearcoatTexture": {"index": 0},
"clearcoatRoughnessFactor": 0.3, "clearcoatRoughnessTexture": {"index": 0})");
  EXPECT_EQ(read.warnings(), "");
  EXPECT_EQ(principledOf(read).clearcoat, 0.8);
  EXPECT_EQ(principledOf(read).clearcoatRoughness, 0.3);
  EXPECT_EQ(read.at("clearcoat", kTopLeft), Color(1)) << "red";
  EXPECT_EQ(read.at("clearcoat", kTopRight), Color(0));
  EXPECT_EQ(read.at("clearcoat_roughness", kTopRight), Color(1)) << "green";
  const Read bumpy =
      extended("KHR_materials_clearcoat", R"("clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0})");
  EXPECT_NE(bumpy.warnings().find("is not rendered yet"), std::string::npos);
}

TEST(GltfExtensions, Sheen) {
  const Read read = extended("KHR_materials_sheen", R"("sheenColorFactor": [0.9, 0.5, 0.1],
"sheenColorTexture": {"index": 0}, "sheenRoughnessFactor": 0.4, "sheenRoughnessTexture": {"index": 0})",
                             "", picture(true));
  EXPECT_EQ(principledOf(read).sheen, Color(0.9, 0.5, 0.1));
  EXPECT_EQ(principledOf(read).sheenRoughness, 0.4);
  expectUpright(read, "sheen");
  EXPECT_EQ(read.at("sheen_roughness", kTopRight), Color(0)) << "its alpha";
}

TEST(GltfExtensions, AnisotropyDrawsTheHighlightOutAsFar) {
  const Read read = extended("KHR_materials_anisotropy",
                             R"("anisotropyStrength": 0.5, "anisotropyRotation": 1.5707963267948966)",
                             "\"roughnessFactor\": 0.6");
  EXPECT_NEAR(principledOf(read).angle, 90, 1e-9);
  // By the extension: 0.6^2 across the tangent, and along it a quarter of the way from there to 1.
  const Microfacets facets =
      Microfacets::of(Distribution::ggx, principledOf(read).roughness, principledOf(read).anisotropy);
  EXPECT_NEAR(facets.y, 0.36, 1e-9);
  EXPECT_NEAR(facets.x, 0.36 + 0.64 * 0.25, 1e-9);
}

TEST(GltfExtensions, Specular) {
  const Read read =
      extended("KHR_materials_specular", R"("specularFactor": 0.5, "specularTexture": {"index": 0},
"specularColorFactor": [1, 0.5, 0.2], "specularColorTexture": {"index": 0})",
               "\"metallicFactor\": 0", picture(true));
  EXPECT_EQ(principledOf(read).specularStrength, 0.5);
  EXPECT_EQ(principledOf(read).specularColor, Color(1, 0.5, 0.2));
  EXPECT_EQ(read.at("specular_strength", kTopRight), Color(0)) << "its alpha";
  expectUpright(read, "specular_color");
}

TEST(GltfExtensions, SpecularGlossiness) {
  const Read read = extended("KHR_materials_pbrSpecularGlossiness",
                             R"("diffuseFactor": [0.5, 0.4, 0.3, 1], "diffuseTexture": {"index": 0},
"specularFactor": [0.2, 0.1, 0.05], "glossinessFactor": 0.8, "specularGlossinessTexture": {"index": 0})",
                             "", picture(true));
  const Principled& model = principledOf(read);
  EXPECT_EQ(model.metallic, 0);
  EXPECT_EQ(model.color, Color(0.5, 0.4, 0.3));
  EXPECT_NEAR(model.plasticMirrors().r, 0.2, 1e-12);
  EXPECT_NEAR(model.plasticMirrors().b, 0.05, 1e-12);
  expectUpright(read, "color");
  expectUpright(read, "specular_color");
  EXPECT_NEAR(model.roughness * read.at("roughness", kTopLeft).r, 0.2, 1e-12) << "1 - 0.8 times alpha 1";
  EXPECT_NEAR(model.roughness * read.at("roughness", kTopRight).r, 1, 1e-12) << "alpha 0";
}

TEST(GltfExtensions, WhatAllLightPassesIsGlass) {
  const std::string all = "\"transmissionFactor\": 1", red = R"("baseColorFactor": [1, 0.5, 0.2, 1],
"metallicFactor": 0, "roughnessFactor": 0.3)";
  const auto read = [&](const std::string& base, const std::string& also) {
    return extended("KHR_materials_transmission", all, base, picture(), also);
  };
  const Read body = read(red, R"(, "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 0.5,
"attenuationColor": [0.9, 0.8, 0.7]}, "KHR_materials_ior": {"ior": 1.7}, "KHR_materials_dispersion": {"dispersion": 0.5})");
  EXPECT_EQ(body.warnings(), "");
  const auto& glass = std::get<RoughGlass>(body.material().model);
  EXPECT_EQ(glass.color, Color(1, 0.5, 0.2));
  EXPECT_EQ(glass.roughness, 0.3);
  EXPECT_EQ(glass.index, 1.7);
  EXPECT_EQ(glass.attenuationColor, Color(0.9, 0.8, 0.7));
  EXPECT_EQ(glass.attenuationDistance, 0.5);
  EXPECT_EQ(glass.abbe, 40) << "20 by the dispersion";

  const Read sheet = read("\"metallicFactor\": 0, \"roughnessFactor\": 0", "");
  EXPECT_TRUE(std::holds_alternative<ThinGlass>(sheet.material().model));
  const Read frosted = read(red, "");
  EXPECT_EQ(std::get<Phong>(frosted.material().model).index, 1) << "a sheet does not bend light";
}

TEST(GltfExtensions, APictureSaysWhereLightPasses) {
  const Read read =
      extended("KHR_materials_transmission",
               R"("transmissionFactor": 0.5, "transmissionTexture": {"index": 0})", "\"metallicFactor\": 0");
  EXPECT_EQ(read.warnings(), "");
  EXPECT_NEAR(read.phongAt(kTopLeft).transmissive.g, 0.5, 1e-12) << "red passes";
  EXPECT_NEAR(read.phongAt(kTopLeft).diffuse.g, 0.5, 1e-12) << "the rest is scattered";
  EXPECT_EQ(read.phongAt(kTopRight).transmissive, Color(0));
  EXPECT_NEAR(read.phongAt(kTopRight).diffuse.g, 1, 1e-12);
}

TEST(GltfExtensions, UnlitShowsItsColourInAnyLight) {
  const Read read = extended("KHR_materials_unlit", "", "\"baseColorTexture\": {\"index\": 0}");
  EXPECT_EQ(read.warnings(), "");
  expectUpright(read, "emissive");
  const Phong phong = phongOf(read.material().model);
  EXPECT_EQ(phong.emissive, kWhite);
  EXPECT_TRUE(isBlack(phong.diffuse) && isBlack(phong.ambient) && isBlack(phong.specular));
}

TEST(GltfExtensions, MeshesWithoutCoordinatesShowOneCorner) {
  std::string text = gltf(kBase);
  text.replace(text.find("TEXCOORD_0"), 10, "TEXCOORD_1");
  const Read read("a.gltf", text);
  EXPECT_EQ(read.mesh().uvs, (std::vector<Vec2>{{0, 1}, {0, 1}, {0, 1}}));
  EXPECT_NE(read.warnings().find("without the texture coordinates of their pictures"), std::string::npos);
}

/// A file of version 1: a triangle whose points and texture coordinates lie in turn, two meshes in one node,
/// and a picture. In a binary one the bytes are its body.
std::string gltf1(bool binary, const std::string& values = R"("diffuse": "paint", "shininess": 6)") {
  const float numbers[] = {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  std::string data(reinterpret_cast<const char*>(numbers), sizeof numbers);
  data += picture();
  const std::string uri = "\"uri\": \"data:application/octet-stream;base64," + base64(data) + "\"";
  const std::string bytes = std::to_string(data.size());
  const std::string image =
      binary ? R"("extensions": {"KHR_binary_glTF": {"bufferView": "pixels", "mimeType": "image/tga"}})"
             : "\"uri\": \"data:image/png;base64," + base64(picture()) + "\"";
  const std::string name = binary ? "binary_glTF" : "all";
  std::string text =
      R"({"asset": {"version": "1.0"}, "scene": "s", "scenes": {"s": {"nodes": ["top"]}},
"nodes": {"below": {"meshes": ["one", "two"], "translation": [1, 2, 3]}, "top": {"children": ["below"]}},
"meshes": {"one": {"primitives": [{"attributes": {"POSITION": "p", "TEXCOORD_0": "t", "WEIGHT": "p"}, "material": "m"}]},
"two": {"primitives": [{"attributes": {"POSITION": "p"}}]}},
"accessors": {"p": {"bufferView": "v", "byteOffset": 0, "byteStride": 20, "componentType": 5126, "count": 3, "type": "VEC3"},
"t": {"bufferView": "v", "byteOffset": 12, "byteStride": 20, "componentType": 5126, "count": 3, "type": "VEC2"}},
"bufferViews": {"pixels": {"buffer": ")" +
      name + R"(", "byteOffset": 60, "byteLength": )" + std::to_string(data.size() - 60) +
      R"(}, "v": {"buffer": ")" + name + R"(", "byteLength": 60}}, "buffers": {")" + name +
      "\": {\"byteLength\": " + bytes + (binary ? "" : ", " + uri) + R"(}}, "images": {"i": {)" + image +
      R"(}}, "samplers": {"s": {"wrapS": 33071}}, "textures": {"paint": {"sampler": "s", "source": "i"}},
"techniques": {"x": {}}, "materials": {"m": {"technique": "x", "values": {)" +
      values + "}}}}";
  if (!binary) return text;
  const auto word = [](std::size_t n) {
    std::string four;
    for (int i = 0; i < 4; ++i) four += static_cast<char>(n >> 8 * i & 255);
    return four;
  };
  return "glTF" + word(1) + word(20 + text.size() + data.size()) + word(text.size()) + word(0) + text + data;
}

TEST(GltfVersion1, IsReadAsVersion2) {
  for (const bool binary : {false, true}) {
    SCOPED_TRACE(binary);
    const Read read("a.gltf", gltf1(binary));
    EXPECT_EQ(read.warnings(), "");
    ASSERT_EQ(read.scene.objects.size(), 2u) << "both meshes of the node";
    EXPECT_EQ(read.scene.objects[0].worldFromObject.offset, (Vec3{1, 2, 3}));
    EXPECT_EQ(read.mesh(0).points, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(read.mesh(0).uvs, (std::vector<Vec2>{{0, 1}, {1, 1}, {0, 0}}));
    expectUpright(read, "color");
    EXPECT_EQ(std::get<ImageMap>(read.texture("color")->model).wrapU, Wrap::clamp);
    const auto& model = std::get<Principled>(read.material().model);
    EXPECT_EQ(model.metallic, 0);
    EXPECT_NEAR(std::pow(model.roughness, 4), 2.0 / (6 + 2), 1e-12)
        << "a lobe as wide as that of the exponent";
  }
}

TEST(GltfVersion1, ColoursAreShownAsTheyAre) {
  const Read read("a.gltf", gltf1(false, R"("diffuse": [0.5, 1, 0, 0.25], "emission": [0.2, 0, 0, 1])"));
  const auto& phong = std::get<Phong>(read.material().model);
  EXPECT_NEAR(phong.diffuse.r, linearOfSrgb(0.5) * 0.25, 1e-12);
  EXPECT_NEAR(phong.emissive.r, linearOfSrgb(0.2), 1e-12);
  EXPECT_NEAR(phong.transmissive.g, 0.75, 1e-12);
}

TEST(GltfVersion1, NamesOfNothingAreErrors) {
  std::string text = gltf1(false);
  text.replace(text.find("\"one\", \"two\""), 12, "\"one\", \"tow\"");
  EXPECT_THROW(Read("a.gltf", text), Error);
  EXPECT_THROW(Read("a.gltf", gltf1(true).substr(0, 900)), Error) << "cut";
}

TEST(GltfTextures, BrokenOnesAreWarnings) {
  const std::string cut = picture().substr(0, 22);
  const Read read("a.gltf", gltf(kBase, "\"source\": 0", "", cut));
  EXPECT_NEAR(read.at("color", {1 / 16.0, 15 / 16.0}).b, 1, 1e-12) << "the checker";
  EXPECT_NE(read.warnings().find("the texture \"a.gltf#images[0]\" cannot be read"), std::string::npos)
      << read.warnings();
  EXPECT_THROW(Read("a.gltf", gltf(kBase, R"("source": 0, "sampler": 3)")), Error);
  const Read other("a.gltf", gltf(R"("emissiveTexture": {"index": 0, "texCoord": 1}, )" + kBase));
  EXPECT_NE(other.warnings().find("is not rendered yet"), std::string::npos) << "a mesh has one set";
}

// --- OBJ ----------------------------------------------------------------------------------------------

struct ObjTextures : testing::Test {
  test::Folder folder;
  Read read(const std::string& mtl, const std::string& picture_ = picture()) {
    writeFile(folder / "a.tga", picture_);
    writeFile(folder / "a.mtl", "newmtl m\n" + mtl + "\n");
    return {folder / "a.obj",
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
            "f 1/1 2/2 3/3\n"};
  }
};

TEST_F(ObjTextures, PicturesStandUprightAndAreScaledByTheirConstant) {
  const Read plain = read("map_Kd a.tga");
  EXPECT_EQ(plain.warnings(), "");
  expectUpright(plain, "diffuse");
  EXPECT_EQ(plain.phongAt(kTopLeft).diffuse, kRed) << "white without Kd";
  EXPECT_EQ(read("map_Kd a.tga\nKd 0.5 0.5 0.5").phongAt(kTopLeft).diffuse, kRed * 0.5);
  EXPECT_EQ(read("Kd 0.5\nmap_Kd a.tga").phongAt(kTopLeft).diffuse, kRed * 0.5);
  EXPECT_EQ(read("map_Ke a.tga\nmap_Ks a.tga\nillum 3").phongAt(kTopRight).reflective, kGreen);
  EXPECT_EQ(read("Ka 1 1 1\nmap_Kd a.tga").phongAt(kTopRight).ambient, kGreen) << "paint in any light";
}

TEST_F(ObjTextures, OptionsPlaceThePicture) {
  EXPECT_EQ(read("map_Kd -s 2 2 a.tga").at("diffuse", {0.375, 0.375}), kGreen);
  EXPECT_EQ(read("map_Kd -o 0.5 a.tga").at("diffuse", kTopLeft), kGreen);
  EXPECT_EQ(read("map_Kd -o 0 0.5 0 -s 1 1 1 a.tga").at("diffuse", kTopLeft), kBlue);
  EXPECT_EQ(read("map_Kd -clamp on a.tga").at("diffuse", {1.25, 0.75}), kGreen);
  EXPECT_EQ(read("map_Ks -imfchan g a.tga").at("specular", kTopRight), kWhite);
  EXPECT_NE(read("map_Kd -mm 0 2 a.tga").warnings().find("the option \"-mm\" of a texture is ignored"),
            std::string::npos);
}

TEST_F(ObjTextures, BumpsAreHeightsByTheModelsSize) {
  const Read heights = read("map_Bump -bm 2 a.tga");
  EXPECT_EQ(heights.warnings(), "");
  EXPECT_EQ(std::get<ImageMap>(heights.texture("bump")->model).relief, Relief::heights);
  EXPECT_NEAR(heights.material().bump, 2.0 / 200, 1e-7) << "of a triangle with sides of 1";
  EXPECT_NEAR(read("bump a.tga").material().bump, 1.0 / 200, 1e-7);
  const Read normals = read("bump a.tga\nnorm a.tga");
  EXPECT_EQ(std::get<ImageMap>(normals.texture("bump")->model).relief, Relief::normals);
  EXPECT_EQ(normals.material().bump, 1);
}

TEST_F(ObjTextures, DisplacementIsHeightsUnlessOthersAreGiven) {
  for (const char* statement : {"disp", "map_disp", "map_Disp"}) {
    const Read alone = read(std::string(statement) + " -bm 3 a.tga");
    EXPECT_EQ(alone.warnings(), "") << statement;
    EXPECT_EQ(std::get<ImageMap>(alone.texture("bump")->model).relief, Relief::heights);
    EXPECT_NEAR(alone.material().bump, 3.0 / 200, 1e-7);
  }
  for (const char* other : {"bump", "norm"}) {
    const Read both = read(std::string(other) + " a.tga\ndisp b.tga");
    EXPECT_NE(both.warnings().find("the texture \"b.tga\" is not rendered yet"), std::string::npos) << other;
    EXPECT_EQ(std::get<ImageMap>(both.texture("bump")->model).file.file.find("a.tga"), 0u);
  }
}

TEST_F(ObjTextures, NamesOfOtherMachines) {
  expectUpright(read("map_Kd C:\\Users\\somebody\\maps\\a.tga"), "diffuse");
  expectUpright(read("map_Kd .\\a.tga"), "diffuse");
  expectUpright(read("map_Kd /home/somebody/a.tga"), "diffuse");
  EXPECT_NE(read("map_Kd C:\\gone.tga").warnings().find("cannot be read"), std::string::npos);
}

TEST_F(ObjTextures, TransparencyCutsHoles) {
  const Read byAlpha = read("map_Kd a.tga", picture(true));
  EXPECT_EQ(byAlpha.phongAt(kTopLeft).transmissive, Color(0));
  EXPECT_EQ(byAlpha.phongAt(kTopRight).transmissive, kWhite);
  EXPECT_NEAR(byAlpha.phongAt(kBottomRight).diffuse.r, 0.2, 1e-9);
  const Read byMap = read("Kd 1 1 1\nmap_d a.tga");
  EXPECT_NEAR(byMap.phongAt(kTopLeft).transmissive.r, 1 - 0.299, 1e-9) << "its luminance";
  EXPECT_EQ(byMap.phongAt(kBottomRight).transmissive, Color(0));
  EXPECT_EQ(read("Kd 1 1 1\nNi 1.5\nmap_d a.tga").phongAt(kTopLeft).index, 1) << "a hole does not bend light";
  EXPECT_EQ(read("map_Kd a.tga").material().textures.size(), 1u) << "an opaque picture makes none";
}

TEST_F(ObjTextures, PhysicalMaterialsArePrincipled) {
  const Read numbers =
      read("Kd 0.5 0.4 0.3\nPr 0.25\nPm 1\nPs 0.5\nPc 0.75\nPcr 0.125\naniso 0.5\nanisor 0.25\nd 0.5");
  EXPECT_EQ(numbers.warnings(), "");
  const auto& model = std::get<Principled>(numbers.material().model);
  EXPECT_EQ(model.color, Color(Real(0.5f), Real(0.4f), Real(0.3f)));
  EXPECT_EQ(model.roughness, 0.25);
  EXPECT_EQ(model.metallic, 1);
  EXPECT_EQ(model.sheen, Color(0.5));
  EXPECT_EQ(model.clearcoat, 0.75);
  EXPECT_EQ(model.clearcoatRoughness, 0.125);
  EXPECT_EQ(model.anisotropy, 0.5);
  EXPECT_EQ(model.angle, 90);
  EXPECT_EQ(numbers.material().opacity, 0.5);
  const Read maps = read("map_Kd a.tga\nmap_Pr a.tga\nmap_Pm -imfchan b a.tga", picture(true));
  EXPECT_EQ(maps.warnings(), "");
  expectUpright(maps, "color");
  EXPECT_EQ(std::get<Principled>(maps.material().model).roughness, 1) << "where only the picture says it";
  expectUpright(maps, "roughness");
  EXPECT_EQ(maps.at("metallic", kBottomLeft), Color(1));
  EXPECT_EQ(maps.at("opacity", kTopRight), Color(0)) << "its alpha";
  EXPECT_NE(read("Pr 3").warnings().find("Pr: expected 0 to 1"), std::string::npos);
  EXPECT_NE(read("Pr 0.3\nmap_Ns a.tga").warnings().find("the texture \"a.tga\" is not rendered yet"),
            std::string::npos)
      << "it has a roughness, and no exponent";
  EXPECT_EQ(read("Ns 30\nmap_Ns a.tga").warnings(), "");
  const Read pane = read("illum 6\nTf 1 0.5 1\nNi 1.45\nPr 0.25");
  const auto& glass = std::get<RoughGlass>(pane.material().model);
  EXPECT_EQ(glass.color, Color(1, 0.5, 1)) << "what says glass is not lost beside a roughness";
  EXPECT_EQ(glass.index, Real(1.45f));
  EXPECT_EQ(glass.roughness, 0.25);
  EXPECT_TRUE(std::holds_alternative<Principled>(read("illum 6\nTf 1 1 1\nPr 0.25\nPm 1").material().model));
}

// --- PLY ----------------------------------------------------------------------------------------------

TEST(PlyTextures, AreSeen) {
  const test::Folder folder;
  writeFile(folder / "a.tga", picture());
  const auto file = [](const std::string& uv) {
    return "ply\nformat ascii 1.0\ncomment TextureFile a.tga\nelement vertex 3\nproperty float x\nproperty "
           "float "
           "y\nproperty float z\nproperty float " +
           uv +
           "\nproperty float t\nelement face 1\nproperty list uchar "
           "int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  };
  const Read read(folder / "a.ply", file("s"));
  EXPECT_EQ(read.warnings(), "");
  expectUpright(read, "diffuse");
  EXPECT_NE(Read(folder / "b.ply", file("q")).warnings().find("not rendered"), std::string::npos)
      << "without texture coordinates";
}

// --- Inventor and VRML --------------------------------------------------------------------------------

const std::string kVrml = "#VRML V2.0 utf8\n", kOld = "#Inventor V2.1 ascii\n";
/// As in a file, from the bottom left: blue, white; red, green.
const std::string kImage = "image 2 2 3 0x0000FF 0xFFFFFF 0xFF0000 0x00FF00 ";

std::string shape(const std::string& texture, const std::string& geometry = "Sphere { }",
                  const std::string& material = "Material { diffuseColor 0.5 0.5 0.5 }") {
  return kVrml + "Shape { appearance Appearance { material " + material + " " + texture + " } geometry " +
         geometry + " }\n";
}

TEST(VrmlTextures, PixelsStandUpright) {
  const Read read("a.wrl", shape("texture PixelTexture { " + kImage + "}"));
  EXPECT_EQ(read.warnings(), "");
  expectUpright(read, "diffuse");
  EXPECT_EQ(read.phongAt(kTopLeft).diffuse, kRed) << "a coloured picture takes the place of the colour";
  const Read grey("a.wrl", shape("texture PixelTexture { image 1 2 2 0x80FF 0xFF00 }"));
  EXPECT_NEAR(grey.phongAt({0.5, 0.25}).diffuse.r, 0.5 * 128 / 255, 1e-9) << "a grey one is multiplied";
  EXPECT_EQ(grey.phongAt({0.5, 0.75}).transmissive, kWhite) << "its alpha cuts holes";
  EXPECT_EQ(Read("a.wrl", shape("texture PixelTexture { " + kImage + " repeatS FALSE }"))
                .at("diffuse", {1.25, 0.75}),
            kGreen);
  const Read unlit("a.wrl", kVrml + "Shape { appearance Appearance { texture PixelTexture { " + kImage +
                                "} } geometry Sphere { } }");
  expectUpright(unlit, "emissive");
  const Read broken("a.wrl", shape("texture PixelTexture { image 20000 20000 3 1 2 }"));
  EXPECT_NE(broken.warnings().find("image of PixelTexture: expected"), std::string::npos);
}

TEST(VrmlTextures, TransformsAreThoseOfTheSpecifications) {
  const auto at = [](const std::string& transform, const Vec2& uv) {
    return Read("a.wrl", shape("texture PixelTexture { " + kImage + "} textureTransform TextureTransform { " +
                               transform + " }"))
        .at("diffuse", uv);
  };
  EXPECT_EQ(at("translation 0.5 0", kTopLeft), kGreen);
  EXPECT_EQ(at("scale 2 2", {0.375, 0.375}), kGreen);
  EXPECT_EQ(at("rotation 1.5707963267948966", kBottomLeft), kWhite) << "(0.25, 0.25) becomes (-0.25, 0.25)";
  EXPECT_EQ(at("center 0.5 0.5 scale 2 1", {0.125, 0.25}), kWhite) << "2 (0.125 + 0.5) - 0.5 = 0.75";
  const auto old = [](const std::string& transforms, const Vec2& uv) {
    return Read("a.iv", kOld + "Texture2 { " + kImage + "} " + transforms + " Sphere { }").at("diffuse", uv);
  };
  EXPECT_EQ(old("Texture2Transform { translation 0.5 0 }", kTopLeft), kGreen);
  EXPECT_EQ(old("Texture2Transform { translation 0.5 0 } Texture2Transform { translation 0 0.5 }", kTopLeft),
            kWhite)
      << "they add up";
  const Color turned = old("Texture2Transform { center 0.5 0.5 rotation 3.141592653589793 }", kTopLeft);
  EXPECT_NEAR(min(turned.r, min(turned.g, turned.b)), 1, 1e-12) << "about the centre";
}

TEST(VrmlTextures, ModelsOfInventor) {
  const auto with = [](const std::string& model) {
    return Read("a.iv", kOld + "Material { diffuseColor 0.5 0.5 0.5 specularColor 1 1 1 } Texture2 { " +
                            kImage + model + " } Sphere { }");
  };
  EXPECT_EQ(with("").phongAt(kTopLeft).diffuse, kRed * 0.5) << "multiplied";
  const Phong decal = with("model DECAL").phongAt(kTopLeft);
  EXPECT_EQ(decal.emissive, kRed);
  EXPECT_TRUE(isBlack(decal.diffuse) && isBlack(decal.specular));
  const Phong blend = with("model BLEND blendColor 1 1 0").phongAt(kBottomRight);
  EXPECT_EQ(blend.emissive, Color(1, 1, 0));
  EXPECT_TRUE(isBlack(blend.diffuse));
  EXPECT_EQ(with("wrapS CLAMP").at("diffuse", {1.25, 0.75}), kGreen);
}

/// Where on the mesh the texture coordinates are (u, v), on a face that looks along `normal`.
Vec3 pointOf(const MeshData& mesh, const Vec2& uv, const Vec3& normal) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t corner : mesh.triangles[t])
      if (mesh.uvs[corner] == uv && dot(faceNormal(mesh, t), normal) > 0)
        return {mesh.points[corner].x, mesh.points[corner].y, mesh.points[corner].z};
  return {99, 99, 99};
}

TEST(VrmlTextures, BoxesHaveAPictureOnEachSide) {
  const Read read("a.wrl", shape("texture PixelTexture { " + kImage + "}", "Box { size 2 4 6 }"));
  const MeshData& box = read.mesh();
  EXPECT_EQ(box.triangles.size(), 12u);
  EXPECT_EQ(pointOf(box, {0, 0}, {0, 0, 1}), (Vec3{-1, -2, 3})) << "front";
  EXPECT_EQ(pointOf(box, {1, 0}, {0, 0, -1}), (Vec3{-1, -2, -3})) << "back";
  EXPECT_EQ(pointOf(box, {1, 0}, {1, 0, 0}), (Vec3{1, -2, -3})) << "right";
  EXPECT_EQ(pointOf(box, {1, 1}, {-1, 0, 0}), (Vec3{-1, 2, 3})) << "left";
  EXPECT_EQ(pointOf(box, {0, 0}, {0, 1, 0}), (Vec3{-1, 2, 3})) << "top, tilted to the eye";
  EXPECT_EQ(pointOf(box, {0, 1}, {0, -1, 0}), (Vec3{-1, -2, 3})) << "bottom";
  EXPECT_FALSE(Read("a.wrl", shape("", "Box { }")).scene.objects.at(0).shape.as<Mesh>())
      << "others stay boxes";
}

TEST(VrmlTextures, FacesWithoutCoordinatesTakeThemFromTheirBox) {
  const Read read("a.wrl", shape("texture PixelTexture { " + kImage + "}",
                                 "IndexedFaceSet { coord Coordinate { point [ 1 0 0, 1 2 0, 1 2 4, 1 0 4 ] } "
                                 "coordIndex [ 0 1 2 3 -1 ] }"));
  EXPECT_EQ(read.mesh().uvs, (std::vector<Vec2>{{0, 0}, {0, 0.5}, {1, 0.5}, {1, 0}}));
}

TEST(VrmlTextures, FilesOfAListAndMissingOnes) {
  const test::Folder folder;
  writeFile(folder / "a.tga", picture());
  const Read read(folder / "a.wrl",
                  shape("texture ImageTexture { url [ \"gone.tga\", \"maps\\\\a.tga\" ] }"));
  expectUpright(read, "diffuse");
  const Read gone(folder / "b.wrl", shape("texture ImageTexture { url \"gone.tga\" }"));
  ASSERT_EQ(gone.messages.all().size(), 1u);
  EXPECT_EQ(gone.messages.all()[0].place.line, 2) << "where the file names it";
}

// --- heads of pictures --------------------------------------------------------------------------------

TEST(PictureKinds, FollowFromTheHead) {
  EXPECT_TRUE(kindOfPicture(picture(true)).transparent);
  EXPECT_FALSE(kindOfPicture(picture()).transparent);
  const std::string png =
      std::string("\x89PNG\r\n\x1a\n", 8) + std::string("\0\0\0\rIHDR", 8) + std::string(8, '\1');
  EXPECT_TRUE(kindOfPicture(png + std::string("\x8\x6\0\0\0", 5) + "crc.").transparent);
  EXPECT_FALSE(kindOfPicture(png + std::string("\x8\0\0\0\0", 5) + "crc.").colored);
  const std::string chunk("\0\0\0\1tRNSxcrc.", 13);
  EXPECT_TRUE(kindOfPicture(png + std::string("\x8\x3\0\0\0", 5) + "crc." + chunk).transparent);
  for (std::size_t length : {0, 3, 17})
    EXPECT_FALSE(kindOfPicture(picture(true).substr(0, length)).transparent);
}

}  // namespace
}  // namespace trace::model_textures_test
