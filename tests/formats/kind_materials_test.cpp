// Files of the kind `Trace 1`: what they say of a material is kept apart from what they leave out.
#include <gtest/gtest.h>

#include <string>

#include "formats/format.h"

namespace trace::kind_materials_test {
namespace {

Scene read(const std::string& text) {
  Messages messages;
  return readScene("kind.ray", text, messages);
}
Color diffuseOf(const Scene& scene) {
  return phongOf(scene.materials.at(scene.objects.at(0).material)).diffuse;
}
Color diffuseOf(const std::string& text) { return diffuseOf(read(text)); }

constexpr const char* kBlack[] = {"diffuse = (0,0,0)",           "diffuse = 0",
                                  "diffuse = #000000",           "diffuse = (0,0,0); ambient = (0,0,0)",
                                  "reflective = (0,0,0)",        "diffuse = (0,0,0); sides = front",
                                  "model = phong; shininess = 0"};

TEST(KindMaterials, BlackIsBlack) {
  for (const std::string black : kBlack)
    for (const std::string& text :
         {"sphere { material = { " + black + " } }", "material = { " + black + " } sphere { }",
          "let ink = material { " + black + " } sphere { material = ink }",
          "define ball() { sphere { } } ball() { material = { " + black + " } }",
          "let ball = group { sphere { } } ball { material = { " + black + " } }",
          "material = { " + black + " } sphere { material = { } }",
          "union { material = { " + black + " } sphere { } translate(1, 0, 0) { box { } } }"})
      EXPECT_EQ(diffuseOf("Trace 1\n" + text), Color(0)) << text;
}

TEST(KindMaterials, WhatIsLeftOutIsGrey) {
  for (const std::string text :
       {"sphere { }", "sphere { material = { } }", "sphere { material = { sides = front } }",
        "sphere { material = { name = \"plain\" } }", "let plain = material { } sphere { material = plain }"})
    EXPECT_EQ(diffuseOf("Trace 1\n" + text), Color(0.7)) << text;
  EXPECT_EQ(diffuseOf("SBT-raytracer 1.0 sphere { }"), Color(0)) << "files of the courses keep their meaning";
}

TEST(KindMaterials, BothInOneFileStayTwo) {
  const Scene scene = read("Trace 1\nsphere { } sphere { material = { diffuse = 0 } } sphere { }");
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].material, scene.objects[2].material);
  EXPECT_NE(scene.objects[0].material, scene.objects[1].material);
  EXPECT_EQ(phongOf(scene.materials.at(scene.objects[1].material)).diffuse, Color(0));
}

TEST(KindMaterials, AConvertedFileSaysTheSame) {
  for (const std::string text : {"sphere { }", "sphere { material = { diffuse = 0 } }"}) {
    const Scene scene = read("Trace 1\n" + text);
    Messages messages;
    const std::string plain = writableFormatFor("out.ray").write(scene, "out.ray", {}, messages).at(0).bytes;
    EXPECT_EQ(diffuseOf(plain), diffuseOf(scene)) << text;
  }
}

}  // namespace
}  // namespace trace::kind_materials_test
