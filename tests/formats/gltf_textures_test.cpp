// Pictures of glTF: exact texels, by the texture coordinates of their meshes.
#include "model_texture_helpers.h"
#include "shading/materials/principled.h"
#include "shading/textures/image_map.h"

namespace trace::gltf_textures_test {
namespace {

using namespace test;

TEST(GltfTextures, PicturesInsideTheFileStandUpright) {
  const Read read("a.gltf", gltf(kBase));
  EXPECT_EQ(read.warnings(), "");
  EXPECT_TRUE(read.material().model.is<Principled>());
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
  const auto& map = *read.texture("bump")->model.as<ImageMap>();
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
  EXPECT_NEAR(blend.opacityAt(kTopLeft), 0.5, 1e-9);
  EXPECT_EQ(blend.opacityAt(kTopRight), 0);
  EXPECT_NEAR(blend.opacityAt(kBottomRight), 0.5 * 51 / 255, 1e-9);
  const Read mask = with("MASK", 1);  // the cutoff is 0.5
  EXPECT_EQ(mask.opacityAt(kTopLeft), 1);
  EXPECT_EQ(mask.phongAt(kBottomLeft).diffuse, kBlue) << "128 of 255 are enough";
  EXPECT_EQ(mask.opacityAt(kBottomRight), 0);
  EXPECT_TRUE(with("OPAQUE", 0.5).material().model.is<Principled>());
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
    EXPECT_TRUE(read->material().model.is<Principled>());
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
  const auto& model = *read.material().model.as<Principled>();
  EXPECT_EQ(model.iridescence, 0.7);
  EXPECT_EQ(model.iridescenceIndex, 1.4);
  EXPECT_EQ(model.iridescenceThickness, 500);
  EXPECT_NEAR(read.at("iridescence_thickness", kTopLeft).g, 0.2, 1e-12) << "no green";
  EXPECT_NEAR(read.at("iridescence_thickness", kTopRight).g, 1, 1e-12);
  const Read glass("a.gltf", gltf(R"("extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
"KHR_materials_volume": {"thicknessFactor": 1}, "KHR_materials_iridescence": {"iridescenceFactor": 1}})"));
  EXPECT_NE(glass.warnings().find("its iridescence is not rendered"), std::string::npos);
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
    EXPECT_EQ(read.texture("color")->model.as<ImageMap>()->wrapU, Wrap::clamp);
    const auto& model = *read.material().model.as<Principled>();
    EXPECT_EQ(model.metallic, 0);
    EXPECT_NEAR(std::pow(model.roughness, 4), 2.0 / (6 + 2), 1e-12)
        << "a lobe as wide as that of the exponent";
  }
}

TEST(GltfVersion1, ColoursAreShownAsTheyAre) {
  const Read read("a.gltf", gltf1(false, R"("diffuse": [0.5, 1, 0, 0.25], "emission": [0.2, 0, 0, 1])"));
  const auto& phong = *read.material().model.as<Phong>();
  EXPECT_NEAR(phong.diffuse.r, linearOfSrgb(0.5), 1e-12);
  EXPECT_NEAR(phong.emissive.r, linearOfSrgb(0.2), 1e-12);
  EXPECT_EQ(read.material().opacity, 0.25);
}

TEST(GltfVersion1, ItsAnimationsArePlayedTogether) {
  std::string text = gltf1(false);
  text.replace(text.find("\"techniques\""), 0, R"("animations": {
"a": {"channels": [{"sampler": "x", "target": {"id": "below", "path": "translation"}}],
      "parameters": {"TIME": "when", "translation": "where"}, "samplers": {"x": {"input": "TIME", "output": "translation"}}},
"b": {"channels": [{"sampler": "x", "target": {"id": "top", "path": "translation"}}],
      "parameters": {"TIME": "when", "translation": "top"}, "samplers": {"x": {"input": "TIME", "output": "translation"}}}}, )");
  const std::string view = R"("bufferView": "v", "componentType": 5126, "count": 1)";
  text.replace(text.find("\"accessors\": {") + 14, 0,
               "\"when\": {" + view + R"(, "type": "SCALAR"}, "where": {"byteOffset": 20, )" + view +
                   R"(, "type": "VEC3"}, "top": {"byteOffset": 36, )" + view + R"(, "type": "VEC3"}, )");
  const Read read("a.gltf", text);
  EXPECT_EQ(read.warnings(), "");
  ASSERT_EQ(read.scene.objects.size(), 2u);
  EXPECT_EQ(read.scene.objects[0].worldFromObject.offset, (Vec3{1, 0, 1})) << "the sum of both keys";
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
  const Read other("a.gltf", gltf(R"("emissiveTexture": {"index": 0, "texCoord": 1},
"occlusionTexture": {"index": 0, "texCoord": 2}, )" +
                                  kBase));
  EXPECT_NE(other.warnings().find("is not rendered yet"), std::string::npos) << "a mesh has two sets";
}

TEST(GltfTextures, AMaterialMayUseTwoSetsOfCoordinates) {
  const auto with = [](const std::string& info) {
    std::string text = gltf("\"emissiveTexture\": {" + info + "}, " + kBase);
    text.replace(text.find("\"TEXCOORD_0\": 1"), 15, R"("TEXCOORD_0": 1, "TEXCOORD_1": 2)");
    // The second coordinates lie 8 bytes after the first: (1, 0), (0, 1), (0, 0).
    text.replace(text.find("],\n\"bufferViews\""), 0,
                 R"(, {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC2"})");
    text.replace(text.find("}], \"buffers\""), 1, R"(}, {"buffer": 0, "byteOffset": 44, "byteLength": 24})");
    return Read("a.gltf", text);
  };
  for (const std::string info :
       {R"("index": 0, "texCoord": 1)",
        R"("index": 0, "texCoord": 3, "extensions": {"KHR_texture_transform": {"texCoord": 1}})"}) {
    const Read read = with(info);
    EXPECT_EQ(read.warnings(), "");
    EXPECT_EQ(read.mesh().uvs, (std::vector<Vec2>{{0, 1}, {1, 1}, {0, 0}}));
    ASSERT_EQ(read.mesh().secondUvs.size(), 3u);
    EXPECT_EQ(read.mesh().secondUvs[0], (Vec2{1, 1}));
    EXPECT_EQ(read.mesh().secondUvs[1], (Vec2{0, 0}));
    TexturePlace place;
    place.uv = kTopLeft;
    place.secondUv = kBottomLeft;
    EXPECT_EQ(read.texture("color").at(place), kRed);
    EXPECT_EQ(read.texture("emissive").at(place), kBlue);
  }
  const Read lacking("a.gltf", gltf(R"("emissiveTexture": {"index": 0, "texCoord": 1}, )" + kBase));
  EXPECT_EQ(lacking.mesh().secondUvs, (std::vector<Vec2>{{0, 1}, {0, 1}, {0, 1}}));
  EXPECT_NE(lacking.warnings().find("without the texture coordinates"), std::string::npos);
}

}  // namespace
}  // namespace trace::gltf_textures_test
