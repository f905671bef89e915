// Shading models in .ray files: chosen, inherited, refused, and edited in the text.
#include <gtest/gtest.h>

#include "formats/ray/write/writer.h"
#include "formats/ray_helpers.h"
#include "formats/ray_patch_helpers.h"
#include "shading/materials/coated.h"
#include "shading/materials/conductor.h"
#include "shading/materials/lambert.h"
#include "shading/materials/oren_nayar.h"

namespace trace::ray_models_test {
namespace {

const Material& materialOf(const Scene& scene, std::size_t object) {
  return scene.materials.at(scene.objects.at(object).material);
}
template <class Model>
const Model& modelOf(const Scene& scene, std::size_t object) {
  return *materialOf(scene, object).model.as<Model>();
}

TEST(RayModels, AreChosenByName) {
  const Scene scene =
      load(
          "sphere { material = { model = oren_nayar; diffuse = (0.5, 0.25, 0); roughness = 1; } }"
          "sphere { material = { metal = gold; distribution = beckmann; model = conductor; } }"
          "sphere { material = { model = phong; shininess = 5; } }")
          .scene;
  EXPECT_EQ(modelOf<OrenNayar>(scene, 0).diffuse, (Color{0.5, 0.25, 0}));
  EXPECT_EQ(modelOf<OrenNayar>(scene, 0).roughness, 1);
  EXPECT_EQ(modelOf<Conductor>(scene, 1).metal, Metal::gold) << "wherever the model stands in the block";
  EXPECT_EQ(modelOf<Conductor>(scene, 1).distribution, Distribution::beckmann);
  EXPECT_EQ(modelOf<Phong>(scene, 2).shininess, 5);
}

TEST(RayModels, InheritWhatTheyShare) {
  const Scene scene =
      load(
          "material = { diffuse = map(\"a.png\"); specular = map(\"b.png\"); ambient = 0.25; }\n"
          "sphere { material = { model = lambert; } }"
          "material = { model = oren_nayar; roughness = 0.75; }"
          "sphere { material = { ambient = 0.5; } }"
          "sphere { material = { model = conductor; } }")
          .scene;
  EXPECT_EQ(modelOf<Lambert>(scene, 0).ambient, Color(0.25));
  ASSERT_EQ(materialOf(scene, 0).textures.size(), 1u) << "there is no specular any more";
  EXPECT_EQ(materialOf(scene, 0).textures[0].field, "diffuse");
  EXPECT_EQ(modelOf<OrenNayar>(scene, 1).roughness, 0.75) << "the model in force goes on";
  EXPECT_EQ(modelOf<OrenNayar>(scene, 1).ambient, Color(0.5));
  EXPECT_EQ(modelOf<Conductor>(scene, 2).roughness, 0.75);
  EXPECT_EQ(modelOf<Conductor>(scene, 2).color, Conductor().color);
}

TEST(RayModels, AreRefusedWithAHint) {
  EXPECT_EQ(
      errorsOf("sphere { material = { model = lamber; } }"),
      "2:31: model: expected the name of a shading model, found \"lamber\" [did you mean \"lambert\"?]");
  EXPECT_EQ(errorsOf("sphere { material = { model = lambert; shininess = 5; } }"),
            "2:40: the shading model lambert has no field \"shininess\" [it has name, bump, opacity, "
            "casts_shadow, displacement, "
            "displacement_levels, pattern_scale, pattern_rotate, pattern_translate, pattern_space, diffuse, "
            "emissive, ambient "
            "and shadow]");
  EXPECT_EQ(
      errorsOf("sphere { material = { model = conductor; metal = god; } }"),
      "2:50: metal: expected none, silver, aluminium, gold, copper or brass, found \"god\" [did you mean "
      "\"gold\"?]");
  EXPECT_EQ(
      warningsOf("sphere { material = { metallic = 1; } }"),
      "2:23: unknown field \"metallic\" of material is ignored: it is one of model = principled [say which "
      "model, before the field]");
  EXPECT_EQ(warningsOf("sphere { material = { model = coated; roughness = 3; } }"),
            "2:39: roughness of material: expected 0 to 1, found 3");
}

TEST(RayModels, HaveHoles) {
  // One after the other, since blocks inherit.
  const Scene scene = load(
                          "material = { model = conductor; opacity = 0.5; }\nsphere { }\n"
                          "sphere { material = { opacity = texture(checker { }, 0.75); } }\n"
                          "sphere { material = { model = lambert; opacity = 1; } }\n"
                          "sphere { material = { library = water; } }\n")
                          .scene;
  const auto material = [&](std::size_t i) { return scene.materials.at(scene.objects.at(i).material); };
  EXPECT_EQ(material(0).opacity, 0.5);
  EXPECT_EQ(material(1).opacity, 0.75);
  ASSERT_TRUE(textureOf(material(1).textures, kOpacity));
  EXPECT_TRUE(material(1).model.is<Conductor>());
  EXPECT_EQ(material(2).opacity, 1);
  EXPECT_EQ(material(3).opacity, 1) << "water of the library has no holes";
  Messages messages;
  const std::string written = writeRay(scene, "b.ray", {}, messages).at(0).bytes;
  const Scene back = readScene("b.ray", written, messages);
  for (std::size_t i = 0; i < 4; ++i) {
    const Material& again = back.materials.at(back.objects.at(i).material);
    EXPECT_EQ(again.opacity, material(i).opacity) << written;
    EXPECT_EQ(textureOf(again.textures, kOpacity) != nullptr, i == 1) << written;
  }
  EXPECT_EQ(warningsOf("sphere { material = { opacity = 3; } }"),
            "2:23: opacity of material: expected 0 to 1, found 3");
}

TEST(RayModels, HolesAreEditedInTheirText) {
  const auto set = [](Real opacity) { return [=](Scene& s) { s.materials[0].opacity = opacity; }; };
  EXPECT_EQ(after("sphere { material = { opacity = 0.25; } }\n", set(0.75)),
            "sphere { material = { opacity = 0.75; } }\n");
  EXPECT_EQ(after("sphere { material = { model = lambert; } }\n", set(0.5)),
            "sphere { material = { model = lambert; opacity = 0.5; } }\n");
}

TEST(RayModels, AreEditedInTheirText) {
  const std::string text = "sphere { material = { model = oren_nayar; roughness = 0.25; } }\n";
  EXPECT_EQ(after(text, [](Scene& s) { s.materials[0].model.edit<OrenNayar>()->roughness = 0.75; }),
            "sphere { material = { model = oren_nayar; roughness = 0.75; } }\n");
  EXPECT_EQ(after(text, [](Scene& s) { s.materials[0] = withModel(s.materials[0], Coated{}); }),
            "sphere { material = { model = coated; roughness = 0.25; } }\n");
}

TEST(RayModels, OfOthersStayWhenTheModelInForceChanges) {
  const std::string text =
      "material = { diffuse = (0.5, 0.5, 0.5); }\nsphere { }\nsphere { material = { specular = (1, 0, 0); } "
      "}\n"
      "sphere { material = { model = lambert; } }\n";
  const SceneText read = reading("test.ray", "SBT-raytracer 1.0\n" + text);
  const Saved result =
      edited(read, [](Scene& s) { s.materials[0] = withModel(s.materials[0], OrenNayar{}); });
  const Scene back = readScene("test.ray", result.text, *std::make_unique<Messages>());
  EXPECT_EQ(modelOf<OrenNayar>(back, 0).diffuse, Color(0.5)) << result.text;
  EXPECT_EQ(modelOf<Phong>(back, 1), modelOf<Phong>(*read.scene, 1)) << result.text;
  EXPECT_EQ(modelOf<Lambert>(back, 2), modelOf<Lambert>(*read.scene, 2)) << result.text;
}

TEST(RayModels, OfOperandsAreWrittenWithThem) {
  const Scene scene =
      load(
          "union { material = { model = conductor; } sphere { material = { model = phong; diffuse = "
          "0.5; } } box { } }")
          .scene;
  Messages messages;
  const std::string text = writeRay(scene, "a.ray", {}, messages).at(0).bytes;
  const Scene back = readScene("a.ray", text, messages);
  ASSERT_EQ(back.materials.size(), scene.materials.size()) << text;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    EXPECT_EQ(back.materials[i].model, scene.materials[i].model) << text;
}

}  // namespace
}  // namespace trace::ray_models_test
