// The files that a scene is made of: all that were read, and all that it names.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/files/file.h"
#include "formats/format.h"
#include "image/codecs/codec.h"
#include "shading/textures/image_map.h"
#include "support/exr.h"
#include "support/folder.h"

namespace trace::test::inputs_test {
namespace {

class Inputs : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { writeFile(folder_ / name, text); }
  void writeGrey(const std::string& name, double level) const {
    Picture picture(4, 4);
    std::fill(picture.pixels.begin(), picture.pixels.end(), Color(level));
    writePicture(folder_ / name, picture);
  }

  Scene read(const std::string& name) const {
    Messages messages;
    return readScene(folder_ / name, messages);
  }

  static constexpr int kNone = 0, kNamed = 1, kRead = 2;
  /// What the scene knows of the file.
  int knows(const Scene& scene, const std::string& name) const {
    int most = kNone;
    for (const InputFile& file : scene.inputs.all())
      if (file.path == folder_ / name) most = std::max(most, file.read ? kRead : kNamed);
    return most;
  }

  const Folder folder_;
};

constexpr const char* kRay = "SBT-raytracer 1.0\ncamera { }\n";
constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(Inputs, OfRay) {
  writeGrey("land.png", 0.5);
  write("m.mtl", "newmtl a\nmap_Kd a.png\nmap_Bump bump.png\nnewmtl unused\nmap_Ks b.png\n");
  write("m.obj", std::string("mtllib m.mtl\nmtllib gone.mtl\n") + kTriangle + "usemtl a\nf 1 2 3\n");
  write("a.ray", std::string(kRay) + R"(height_field { file = "land.png"; }
    mesh { file = "m.obj"; }
    sphere { material = { diffuse = map("wood.png"); } }
    sphere { material = { diffuse = map("bark.png"); diffuse = (1, 1, 1); } })");
  const Scene scene = read("a.ray");
  for (const char* name : {"a.ray", "land.png", "m.obj", "m.mtl"})
    EXPECT_EQ(knows(scene, name), kRead) << name;
  for (const char* name : {"a.png", "b.png", "bump.png", "wood.png", "bark.png"})
    EXPECT_EQ(knows(scene, name), kNamed) << name;
  EXPECT_EQ(knows(scene, "c.png"), kNone);
}

TEST_F(Inputs, LayersOfAPictureAreOneFile) {
  write("a.exr", layeredExr());
  write("a.ray", std::string(kRay) + R"(sphere { material = { diffuse = map("a.exr:left"); } }
    sphere { material = { diffuse = map("a.exr:shine"); } }
    sphere { material = { diffuse = map("a.exr"); } })");
  Messages messages;
  const Scene scene = readScene(folder_ / "a.ray", messages);
  EXPECT_EQ(knows(scene, "a.exr"), kRead);
  EXPECT_EQ(knows(scene, "a.exr:left"), kNone);
  std::vector<double> reds;
  for (const Material& material : scene.materials)
    for (const FieldTexture& texture : material.textures)
      reds.push_back(texture.texture->model.as<ImageMap>()->file.map->texel(0, 0).color.r);
  EXPECT_EQ(reds, (std::vector<double>{2, 3, 1}));
  ASSERT_EQ(std::count_if(messages.all().begin(), messages.all().end(),
                          [](const Message& m) { return m.what.find("layers") != m.what.npos; }),
            1)
      << "of the picture in which none was chosen";
}

TEST_F(Inputs, OfObj) {
  write("sub.mtl", "newmtl a\nmap_Kd duck.png\n");
  write("duck.obj", std::string("mtllib sub.mtl\nmtllib gone.mtl\n") + kTriangle + "usemtl a\nf 1 2 3\n");
  const Scene scene = read("duck.obj");
  EXPECT_EQ(knows(scene, "duck.obj"), kRead);
  EXPECT_EQ(knows(scene, "sub.mtl"), kRead);
  EXPECT_EQ(knows(scene, "duck.png"), kNamed);
}

TEST_F(Inputs, OfGltf) {
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  write("t.bin", std::string(reinterpret_cast<const char*>(points), sizeof points));
  write("t.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"uri": "t.bin", "byteLength": 36}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "images": [{"uri": "t.png"}, {"uri": "unused.png"}]})");
  const Scene scene = read("t.gltf");
  EXPECT_EQ(knows(scene, "t.gltf"), kRead);
  EXPECT_EQ(knows(scene, "t.bin"), kRead);
  EXPECT_EQ(knows(scene, "t.png"), kNamed);
  EXPECT_EQ(knows(scene, "unused.png"), kNamed);
}

TEST_F(Inputs, OfInventor) {
  write("inner.wrl",
        "#VRML V2.0 utf8\nShape { geometry Sphere { } appearance Appearance { texture "
        "ImageTexture { url \"inner.png\" } } }\n");
  write("outer.wrl", "#VRML V2.0 utf8\nInline { url \"inner.wrl\" }\nInline { url \"gone.wrl\" }\n");
  const Scene scene = read("outer.wrl");
  EXPECT_EQ(knows(scene, "outer.wrl"), kRead);
  EXPECT_EQ(knows(scene, "inner.wrl"), kRead);
  EXPECT_EQ(knows(scene, "inner.png"), kNamed);
  EXPECT_EQ(knows(scene, "gone.wrl"), kNamed);
}

TEST_F(Inputs, FingerprintFollowsEveryByteThatWasRead) {
  writeGrey("land.png", 0.5);
  write("m.mtl", "newmtl a\nKd 1 0 0\n");
  write("m.obj", std::string("mtllib m.mtl\n") + kTriangle + "usemtl a\nf 1 2 3\n");
  write("a.ray", std::string(kRay) + "height_field { file = \"land.png\"; } mesh { file = \"m.obj\"; }");
  const std::string before = read("a.ray").inputs.fingerprint();
  EXPECT_EQ(before.size(), 16u);
  EXPECT_EQ(read("a.ray").inputs.fingerprint(), before);
  write("m.mtl", "newmtl a\nKd 0 1 0\n");
  const std::string other = read("a.ray").inputs.fingerprint();
  EXPECT_NE(other, before);
  writeGrey("land.png", 0.25);
  EXPECT_NE(read("a.ray").inputs.fingerprint(), other);
}

}  // namespace
}  // namespace trace::test::inputs_test
