// Scenes written as .ray files read back as equal scenes, and look the same bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "base/files/read_scope.h"
#include "formats/ray/write/writer.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "mesh_helpers.h"
#include "shading/textures/image_map.h"
#include "support/materials.h"
#include "support/paths.h"
#include "support/shapes.h"
#include "support/shared.h"

namespace trace::ray_writer_test {
namespace {

/// Beside the scene's own file, so that both find the same pictures under the same names.
std::string outFile(const Scene& scene) {
  return (std::filesystem::path(scene.file).parent_path() / "out.ray").string();
}

std::string written(const Scene& scene, const WriteOptions& options = {}) {
  Messages messages;
  return writeRay(scene, outFile(scene), options, messages).at(0).bytes;
}

Scene again(const std::string& text, const std::string& file = "out.ray") {
  Messages messages;
  return readScene(file, text, messages);
}

/// What a file says, without where it says it: materials stand with their objects.
std::vector<std::string> unrenderedOf(const Scene& scene) {
  std::vector<std::string> all;
  for (const Unrendered& node : scene.unrendered)
    if (node.kind != "map") all.push_back(node.kind + ": " + node.text);
  return all;
}

/// A material that several objects share gets a name where it has none.
Material named(Material material, const Material& as) {
  if (as.name.empty() && material.name.starts_with("material ")) material.name.clear();
  return material;
}

/// The mesh with the materials of its points out of the way, and these.
std::pair<MeshData, std::vector<Material>> unfolded(const Scene& scene, const MeshData& mesh) {
  std::pair<MeshData, std::vector<Material>> result{mesh, {}};
  for (std::uint32_t& material : result.first.materials) {
    result.second.push_back(named(scene.materials.at(material), {}));
    material = 0;
  }
  return result;
}

void expectEqual(const Scene& a, const Scene& b, const std::string& name) {
  EXPECT_EQ(a.camera, b.camera) << name;
  EXPECT_EQ(a.background, b.background) << name;
  ASSERT_EQ(a.lights.size(), b.lights.size()) << name;
  for (std::size_t i = 0; i < a.lights.size(); ++i) EXPECT_EQ(a.lights[i].light, b.lights[i].light) << name;
  ASSERT_EQ(a.choices.size(), b.choices.size()) << name;
  for (std::size_t i = 0; i < a.choices.size(); ++i) {
    EXPECT_EQ(a.choices[i].option, b.choices[i].option) << name;
    const Option& option = findOption(a.choices[i].option);  // a file has its whole name in what is written
    EXPECT_TRUE(sameValue(option, resolve({{&a.choices[i], 1}}), resolve({{&b.choices[i], 1}})))
        << option.name;
  }
  ASSERT_EQ(a.objects.size(), b.objects.size()) << name;
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const Object &x = a.objects[i], &y = b.objects[i];
    EXPECT_EQ(x.name, y.name) << name;
    EXPECT_EQ(x.worldFromObject, y.worldFromObject) << name << " object " << i;
    const Material& material = a.materials.at(x.material);
    EXPECT_EQ(material, named(b.materials.at(y.material), material)) << name << " object " << i;
    ASSERT_EQ(x.shape.keyword(), y.shape.keyword()) << name << " object " << i;
    const auto* mesh = x.shape.as<Mesh>();
    if (mesh)
      EXPECT_EQ(unfolded(a, *mesh->data), unfolded(b, *y.shape.as<Mesh>()->data)) << name << " object " << i;
    else
      EXPECT_EQ(x.shape, y.shape) << name << " object " << i;
  }
  EXPECT_EQ(unrenderedOf(a), unrenderedOf(b)) << name;
}

void expectRoundTrip(const Scene& scene, const std::string& name) {
  const std::string text = written(scene);
  const Scene back = again(text, outFile(scene));
  expectEqual(scene, back, name);
  EXPECT_EQ(written(back), text) << name;
}

TEST(RayWriter, EveryExampleRoundTrips) {
  const ReadScope allowed({test::sharedFolder(), test::sourceFolder()});
  const auto files = test::filesUnder(test::sourceFolder() + "/scenes", ".ray");
  ASSERT_GE(files.size(), 10u);
  for (const std::string& file : files) {
    Messages messages;
    expectRoundTrip(readScene(file, messages), file);
  }
}

TEST(RayWriter, EverySceneOfTheCoursesRoundTrips) {
  const ReadScope allowed({test::sharedFolder(), test::sourceFolder()});
  TRACE_NEEDS_SHARED("scenes/uw");
  std::size_t scenes = 0;
  for (const std::string& file : test::filesUnder(test::sharedFolder() + "/scenes/uw", ".ray")) {
    Messages messages;
    Scene scene;
    try {
      scene = readScene(file, messages);
    } catch (const Error&) {
      continue;  // a broken one: ray_corpus_test.cpp has them
    }
    expectRoundTrip(scene, file);
    ++scenes;
  }
  EXPECT_GE(scenes, 190u);
}

TEST(RayWriter, EveryShapeLightAndMaterialFieldRoundTrips) {
  Scene scene;
  scene.format = "ray";
  scene.camera.position = {0.1, -1e-300, 1.0 / 3};
  scene.materials.push_back({"", Phong{}, {}});
  test::Random random(5);
  for (const Shape& shape : test::analyticShapes()) {
    const auto* heights = shape.as<HeightField>();
    if (heights && heights->file.grid) continue;  // the picture would have to be there; RayFormat reads one
    scene.objects.push_back({"shape", shape, random.affine(3), 0, {}});
  }
  for (const LightType& type : lightTypes()) {
    Light light(type);
    double value = 0.1;
    editEachField(light, [&]<class Value>(const LightField&, Value& member) {
      if constexpr (std::is_same_v<Value, Vec3>)
        member = {value, 2 * value, 1 / value};
      else if constexpr (std::is_same_v<Value, Color>)
        member = {value, value / 3, 0};
      else if constexpr (std::is_same_v<Value, double>)
        member = value;
      value += 0.7;
    });
    scene.lights.push_back({light, {}});
  }
  for (const test::NamedModel& m : test::variedModels()) {
    scene.materials.push_back({m.name, m.model, {}});
    scene.objects.push_back({"", Sphere{}, {}, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
  }
  expectRoundTrip(scene, "every field");
}

TEST(RayWriter, KeepsHowASurfaceMirrors) {
  for (const bool mirrorsSpecular : {false, true})
    for (const double specular : {0.0, 0.5})
      for (const double reflective : {0.0, 0.25})
        for (const bool picture : {false, true}) {
          Phong phong;
          phong.specular = Color(specular), phong.reflective = Color(reflective);
          phong.mirrorsSpecular = mirrorsSpecular;
          Scene scene;
          scene.format = "ray";
          scene.materials.push_back({"", phong, {}});
          if (picture) scene.materials[0].textures = {{"specular", pictureTexture("a b.png")}};
          scene.objects.push_back({"", Sphere{}, {}, 0, {}});
          expectRoundTrip(scene, written(scene));
        }
}

TEST(RayWriter, WritesASharedMeshOnce) {
  const Scene scene = again(R"(SBT-raytracer 1.0
polymesh { shared = ball; points = ((0,0,0), (1,0,0), (0,1,0)); faces = ((0,1,2)); name = first; }
translate(1, 2, 3, mesh { shared = ball; material = { diffuse = (1, 0, 0); } }))");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(&meshOf(scene, 0), &meshOf(scene, 1));
  expectRoundTrip(scene, "shared");
  const Scene back = again(written(scene));
  EXPECT_EQ(&meshOf(back, 0), &meshOf(back, 1));
  EXPECT_EQ(errorsOf("mesh { shared = 7; }"),
            "2:8: expected the name of a mesh before, found 7 [a mesh is shared by shared = NAME beside its "
            "points]");
}

TEST(RayWriter, WritesASharedMaterialOnce) {
  const Scene scene = again(R"(SBT-raytracer 1.0
material = { diffuse = (1, 0.5, 0); }
sphere { } translate(0, 0, 1, box { })
union { sphere { } box { material = { name = "material 1"; diffuse = (0, 0, 1); }; } })");
  const std::string text = written(scene);
  EXPECT_EQ(text.find("(1, 0.5, 0)"), text.rfind("(1, 0.5, 0)")) << text;
  expectRoundTrip(scene, "shared material");
}

TEST(RayWriter, SaysSimpleTransformsAsAPersonWould) {
  for (const std::string head :
       {"translate(1, -2, 0.3, ", "scale(2.5, ", "scale(1, 2, -3, ", "rotate(0, 1, 0, 0.7, ",
        "translate(1, 2, 3, rotate(1, 1, 0, -1.1, scale(2, ", "translate(0, 0, 1e-05, scale(0.1, 0.2, 0.3, ",
        "rotate(0, 0, 1, 3.141592653589793, "}) {
    const Scene scene =
        again("SBT-raytracer 1.0 " + head + "sphere { }" +
              std::string(static_cast<std::size_t>(std::count(head.begin(), head.end(), '(')), ')'));
    EXPECT_NE(written(scene).find("\n" + head + "sphere {"), std::string::npos) << head << "\n"
                                                                                << written(scene);
    expectRoundTrip(scene, head);
  }
  // What is no product of these to the last bit stays a matrix.
  const Scene sheared = again(
      "SBT-raytracer 1.0 transform((1, 0.5, 0, 0), (0, 1, 0, 0), (0, 0, 1, 7), (0, 0, 0, 1), sphere { })");
  EXPECT_NE(written(sheared).find("transform((1, 0.5, 0, 0), "), std::string::npos);
  expectRoundTrip(sheared, "sheared");
}

std::vector<Message> messagesOf(const std::string& text) {
  Messages messages;
  readScene("out.ray", text, messages);
  return messages.all();
}

TEST(RayWriter, OptionsAreWrittenAsAPersonWritesThem) {
  Scene scene = again("SBT-raytracer 1.0 settings { width = 200; integrator = path; } sphere { }");
  const std::string text = written(scene);
  EXPECT_NE(text.find("  width = 200;"), std::string::npos) << text;
  EXPECT_NE(text.find("  integrator = path;"), std::string::npos) << text;
  EXPECT_EQ(again(text).choices.size(), scene.choices.size());
  scene.choices = {{"environment", "my \"odd.png", {}}};
  EXPECT_THROW(written(scene), Error) << "another file would be named";
}

TEST(RayWriter, AMirrorThatFollowsAHighlightIsReadWithoutAWarning) {
  const Scene scene = again(R"(SBT-raytracer 1.0
material = { reflective = (0.2, 0.2, 0.2); }
sphere { material = { specular = (0.1, 0.1, 0.1); } })");
  ASSERT_TRUE(scene.materials.at(scene.objects.at(0).material).model.as<Phong>()->mirrorsSpecular);
  const std::string text = written(scene);
  expectRoundTrip(scene, "mirror");
  EXPECT_EQ(messagesOf(text), std::vector<Message>{}) << text;
  EXPECT_EQ(
      messagesOf("SBT-raytracer 1.0 sphere { material = { reflective = 1; reflective = 0.5; } }").size(), 1u);
}

TEST(RayWriter, FilesAreNamedAsTheyAreOrNotAtAll) {
  Scene scene = again("SBT-raytracer 1.0 sphere { }");
  for (const char* file : {"a \"b.png", "a\nb.png", "a\x1b[31m.png"}) {
    setTexture(scene.materials[0].textures, "diffuse", pictureTexture(file));
    EXPECT_THROW(written(scene), Error) << file;
  }
  setTexture(scene.materials[0].textures, "diffuse", pictureTexture("a\tb\\'.png"));
  const Scene back = again(written(scene));
  const Texture* texture = textureOf(back.materials.at(back.objects.at(0).material).textures, "diffuse");
  ASSERT_NE(texture, nullptr);
  EXPECT_EQ((*texture)->model.as<ImageMap>()->file.file, "a\tb\\'.png");
}

TEST(RayWriter, NamesWithOddLettersLoseThem) {
  Scene scene = again("SBT-raytracer 1.0 sphere { name = x; }");
  scene.objects[0].name = "say \"hi\"\n// }";
  scene.materials[0].name = "a b";
  const Scene back = again(written(scene));
  EXPECT_EQ(back.objects.at(0).name, "say 'hi' // }");
  EXPECT_EQ(back.materials.at(0).name, "a b");
  Messages messages;
  writeRay(scene, outFile(scene), {}, messages);
  ASSERT_EQ(messages.all().size(), 1u);
  EXPECT_NE(messages.all()[0].what.find("expected a name without"), std::string::npos);
}

TEST(RayWriter, WritesFewerDigitsIfAsked) {
  const Scene scene = again("SBT-raytracer 1.0 camera { position = (0.123456789, 2, 1e-9); }");
  EXPECT_NE(written(scene, {.digits = 3}).find("position = (0.123, 2, 1e-09);"), std::string::npos);
  EXPECT_NE(written(scene).find("position = (0.123456789, 2, 1e-09);"), std::string::npos);
}

TEST(RayWriter, RefusesNumbersThatTheFormatDoesNotHave) {
  Scene scene;
  scene.camera.position.x = kInfinity;
  EXPECT_THROW(written(scene), Error);
}

TEST(RayWriter, KeepsTextOfOtherFormatsAsComments) {
  Scene scene = again("SBT-raytracer 1.0 sphere { }");
  scene.format = "other";
  scene.unrendered.push_back({"Fog", {}, "Fog {\n  strange ( }"});
  EXPECT_EQ(again(written(scene)).objects.size(), 1u);
}

}  // namespace
}  // namespace trace::ray_writer_test
