// Textures in the text of .ray files.
#include "formats/ray/ray_texture.h"

#include <gtest/gtest.h>

#include "formats/ray/ray_writer.h"
#include "ray_helpers.h"

namespace trace {
namespace {

std::vector<FieldTexture> texturesOf(const std::string& fields) {
  const Scene scene = load("sphere { material = { " + fields + " } }").scene;
  return scene.materials.at(scene.objects.at(0).material).textures;
}

const Texture kChecker = TextureNode{.model = Checker{.a = {1, 0, 0}}};

TEST(RayTexture, StandsInPlaceOfAConstant) {
  EXPECT_EQ(texturesOf("diffuse = checker { a = (1, 0, 0); };"),
            (std::vector<FieldTexture>{{"diffuse", kChecker}}));
  const Scene scene = load(
                          "sphere { material = { diffuse = texture(checker { a = (1, 0, 0); }, 0.5);"
                          "shininess = texture(checker { a = (1, 0, 0); }, 40); } }")
                          .scene;
  const Material& material = scene.materials.at(scene.objects.at(0).material);
  EXPECT_EQ(material.textures, (std::vector<FieldTexture>{{"diffuse", kChecker}, {"shininess", kChecker}}));
  EXPECT_EQ(phongOf(material).diffuse, Color(0.5));
  EXPECT_EQ(phongOf(material).shininess, 40);
}

TEST(RayTexture, HasANameForOthers) {
  const Scene scene =
      load(
          "texture = checker { name = floor; a = (1, 0, 0); }\n"
          "sphere { material = { diffuse = texture(\"floor\"); } }\n"
          "box { material = { ambient = checker { a = texture(floor, 0.5); scale = (2, 2, 2); } } }")
          .scene;
  const auto textures = [&](std::size_t i) {
    return scene.materials.at(scene.objects.at(i).material).textures;
  };
  EXPECT_EQ(textures(0).at(0).texture->name, "floor");
  const TextureNode& outer = *textures(1).at(0).texture;
  EXPECT_EQ(outer.inputs.at(0).texture, textures(0).at(0).texture);
  EXPECT_EQ(std::get<Checker>(outer.model).a, Color(0.5));
  EXPECT_EQ(outer.placement.scale, (Vec3{2, 2, 2}));
}

TEST(RayTexture, TellsWhatIsWrong) {
  EXPECT_EQ(errorsOf("sphere { material = { diffuse = texture(\"flor\"); } }"),
            "2:41: expected the name of a texture, found \"flor\" [a texture is named before its first use: "
            "texture "
            "= checker { name = floor; ... }]");
  EXPECT_EQ(
      errorsOf("texture = checker { name = floor; }\nsphere { material = { diffuse = texture(\"flor\"); } }"),
      "3:41: expected the name of a texture, found \"flor\" [did you mean \"floor\"?]");
  EXPECT_EQ(
      errorsOf("texture = cheker { name = floor; }"),
      "2:11: texture: expected a texture, as in checker { }, found cheker { name = floor; } [did you mean "
      "\"checker\"?]");
  EXPECT_EQ(errorsOf("sphere { material = { diffuse = checker { a = 1, 2; } } }"),
            "2:50: checker: expected a field, as in name = value, found 2");
  EXPECT_EQ(warningsOf("sphere { material = { diffuse = checker { c = 1; }; } }"),
            "2:43: unknown field \"c\" of checker is ignored [did you mean \"a\"?]");
}

TEST(RayTexture, IsWrittenAsItIsRead) {
  Messages messages;
  const char* text =
      "texture = checker { name = floor; a = (1, 0, 0); scale = (2, 2, 2); rotate = (0, 0, 45); }\n"
      "sphere { material = { diffuse = texture(floor, 0.5); shininess = texture(floor, 3); "
      "specular = image { file = \"a.png\"; wrap_u = mirror; channel = alpha; transform = (2, 0, 0, 0, 2, "
      "0); };"
      "ambient = map(\"b.png\"); emissive = checker { b = map(\"c.png\", 0.25); }; } }";
  const Scene scene = load(text).scene;
  const std::string written = writeRay(scene, "b.ray", {}, messages).at(0).bytes;
  const Scene back = readScene("b.ray", written, messages);
  EXPECT_EQ(back.materials, scene.materials) << written;
  EXPECT_EQ(written.find("checker { name"), written.rfind("checker { name"))
      << "what has a name is said once";
}

}  // namespace
}  // namespace trace
