// Files of the composer: text and binary, and what they mean.
#include "formats/composer/composer_format.h"

#include "base/files/file.h"
#include "formats/composer/composer_file.h"
#include "formats/textures.h"
#include "geometry/mesh/mesh.h"
#include "image/codecs/codec.h"
#include "mesh_helpers.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/spot_light.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::composer_format_test {
namespace {

std::string corpusFile(const char* name) {
  return readFile(test::sourceFolder() + "/tests/corpus/composer/" + name);
}

std::string headed(const std::string& text) { return "Composer format 2.1 ascii\n" + text; }
std::string seen(const std::string& text) {
  return headed("camera { viewDirection 0 0 -1 orthoUp 0 1 0 verticalFOV 1 }\n" + text);
}

/// Scenes without the places, which only text has.
Scene withoutPlaces(Scene scene) {
  for (Object& object : scene.objects) object.place = {};
  for (LightSource& light : scene.lights) light.place = {};
  for (Choice& choice : scene.choices) choice.place = {};
  return scene;
}

TEST(Composer, ReadsCameraAndLights) {
  const Scene scene = sceneIn(corpusFile("text.out"));
  EXPECT_EQ(scene.format, "composer");
  EXPECT_EQ(scene.camera.position, (Vec3{0, 1, 6}));
  EXPECT_NEAR(scene.camera.fov, 45, 1e-4);
  ASSERT_EQ(scene.lights.size(), 4u);
  const auto& point = *scene.lights[0].light.as<PointLight>();
  EXPECT_EQ((Vec3{point.constant, point.linear, point.quadratic}), (Vec3{0.25, 0.1, 0.01}));
  EXPECT_EQ(scene.lights[1].light.as<DirectionalLight>()->direction, (Vec3{-1, -1, -1}));
  const auto& spot = *scene.lights[2].light.as<SpotLight>();
  EXPECT_NEAR(spot.angle, 0.4 * 180 / kPi, 1e-12);
  EXPECT_NEAR(spot.exponent, 12.8, 1e-12);
  EXPECT_EQ(scene.lights[3].light.as<AmbientLight>()->color, Color(1));
}

TEST(Composer, SpheresHaveThreeAxesOrOneRadius) {
  const auto heightOf = [](const std::string& fields) {
    return linear(sceneIn(seen("sphere {" + fields + "}")).objects[0].worldFromObject, {0, 1, 0}).y;
  };
  EXPECT_EQ(heightOf("radius 1.25 xlength 1 ylength 1.5 zlength 1.25"), 1.5);
  EXPECT_EQ(heightOf("radius 1.25"), 1.25);
}

TEST(Composer, MaterialsAreGlassOfAFixedIndexThatNamesMayChange) {
  const Scene scene = sceneIn(corpusFile("text.out"));
  const Material& material = scene.materials[scene.objects[0].material];
  const Phong& phong = *material.model.as<Phong>();
  EXPECT_EQ(phong.diffuse, Color(0.25, 0.1, 0.1));
  EXPECT_EQ(phong.transmissive, Color(0.5));
  EXPECT_EQ(phong.reflective, Color(0.4));
  EXPECT_EQ(phong.index, 1.33);
  EXPECT_EQ(material.textures, (std::vector<FieldTexture>{{"diffuse", pictureTexture("wood.png")}}));
  EXPECT_EQ(scene.materials[scene.objects[1].material].model.as<Phong>()->index, 1.5);
}

TEST(Composer, PolygonsOfAnySidesWithNormalsMaterialsAndTexture) {
  const Scene scene = sceneIn(corpusFile("text.out"));
  const MeshData& mesh = meshOf(scene, 1);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.normals[0], (Vec3f{0, 0, 1})) << "of length 3 in the file";
  EXPECT_EQ(mesh.materials[1], mesh.materials[0] + 1);
  EXPECT_EQ(mesh.uvs[2], (Vec2{1, 1}));
  EXPECT_TRUE(mesh.twoSided);
}

TEST(Composer, NormalsTellTheSideThatTheOrderOfVerticesDoesNot) {
  const Scene scene = sceneIn(
      seen("poly_set { normType PER_VERTEX_NORMAL poly { pos 0 0 0 norm 0 0 1 pos 0 1 0 norm 0 0 1 pos 1 0 0 "
           "norm 0 0 1 } }"));
  EXPECT_GT(faceNormal(meshOf(scene), 0).z, 0);
}

TEST(Composer, BinaryOfBothByteOrdersIsTheSameScene) {
  const Scene little = withoutPlaces(sceneIn(corpusFile("little.scene")));
  EXPECT_EQ(little, withoutPlaces(sceneIn(corpusFile("big.scene"))));
  const Scene text = withoutPlaces(sceneIn(corpusFile("text.out")));
  ASSERT_EQ(little.objects.size(), text.objects.size());
  EXPECT_EQ(meshOf(little, 1), meshOf(text, 1));
  EXPECT_EQ(little.objects[0].name, text.objects[0].name);
  EXPECT_EQ(little.lights.size(), text.lights.size());
}

TEST(Composer, TextIsWrittenAsItIsRead) {
  Messages messages;
  const std::string bytes = corpusFile("text.out");
  const composer::File file = composer::readText("a", bytes, bytes.find('\n') + 1, messages);
  const std::string once = composer::writeText(file);
  const composer::File again = composer::readText("a", once, once.find('\n') + 1, messages);
  EXPECT_EQ(composer::writeText(again), once);
  Scene a = sceneIn(bytes), b = sceneIn(once);
  EXPECT_EQ(withoutPlaces(a), withoutPlaces(b));
}

TEST(Composer, ScenesAreWritten) {
  const Scene scene = sceneIn(corpusFile("text.out"));
  Messages messages;
  const Scene again = sceneIn(writeComposer(scene, "a.out", {}, messages)[0].bytes);
  EXPECT_TRUE(messages.all().empty());
  ASSERT_EQ(again.objects.size(), scene.objects.size());
  EXPECT_EQ(again.objects[0].name, scene.objects[0].name);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(length(again.objects[0].worldFromObject.row[i] - scene.objects[0].worldFromObject.row[i]),
              1e-14);
  EXPECT_EQ(meshOf(again, 1).triangles.size(), meshOf(scene, 1).triangles.size());
  const Phong a = phongOf(scene, 0), b = phongOf(again, 0);
  EXPECT_NEAR(a.diffuse.r, b.diffuse.r, 1e-14);
  EXPECT_NEAR(a.ambient.r, b.ambient.r, 1e-14);
  EXPECT_EQ(a.reflective, b.reflective);
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.shininess, b.shininess);
}

TEST(Composer, OtherShapesBecomeTriangles) {
  Messages messages;
  const Scene scene = load("translate(1, 2, 3, box { material = { diffuse = (1, 0, 0); } }) plane { }").scene;
  const std::string text = writeComposer(scene, "a.out", {.digits = 4}, messages)[0].bytes;
  EXPECT_EQ(messages.all().size(), 2u);
  const Scene again = sceneIn(text);
  ASSERT_EQ(again.objects.size(), 1u);
  EXPECT_EQ(bounds(meshOf(again)), (Box3{{0.5, 1.5, 2.5}, {1.5, 2.5, 3.5}}));
  EXPECT_EQ(text.substr(0, 25), "Composer format 2.1 ascii");
}

TEST(Composer, NothingIsWrittenWhereNoObjectIsLeft) {
  Messages messages;
  const Scene endless = load("plane { }").scene;
  try {
    writeComposer(endless, "a.out", {}, messages);
    ADD_FAILURE() << "a file without objects";
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::scene);
    EXPECT_NE(std::string(error.what()).find("expected a scene with meshes, found 1 plane"),
              std::string::npos)
        << error.what();
  }
}

TEST(Composer, PicturesAreWrittenOfWhateverModelAndLieOnMadeTriangles) {
  const test::Folder folder;
  Picture grey(2, 1);
  grey.pixels = {Color(1, 1, 1), Color(0, 0, 0)};
  writePicture(folder / "a.png", grey);
  Messages messages;
  const auto written = [&](const std::string& object) {
    Scene scene = readScene(folder / "s.ray",
                            "SBT-raytracer 1.0\nambient_light { color = (1, 1, 1); }\n" + object, messages);
    loadTextures(scene, messages);
    return sceneIn(writeComposer(scene, folder / "s.out", {}, messages)[0].bytes);
  };
  const std::string map = "texture(image { file = \"a.png\"; })";
  const Scene card = written("square { material = { model = principled; color = " + map + "; } }");
  ASSERT_NE(textureOf(card.materials.at(card.objects.at(0).material).textures, "diffuse"), nullptr);
  EXPECT_FALSE(card.objects.at(0).shape.as<Mesh>()->data->uvs.empty());
  const Scene ball = written("sphere { material = { diffuse = " + map + "; ambient = " + map + "; } }");
  const Phong phong = phongOf(ball.materials.at(ball.objects.at(0).material).model);
  EXPECT_NEAR(phong.ambient.g, 0.5, 0.01) << "the mean of the picture";
}

TEST(Composer, WithoutACameraEverythingIsSeen) {
  Messages messages;
  const Scene scene = readScene("a", headed("sphere { origin 5 5 5 radius 2 }"), messages);
  EXPECT_EQ(messages.all().size(), 1u);
  const Vec3 toBall = normalize(Vec3{5, 5, 5} - scene.camera.position);
  EXPECT_GT(dot(toBall, normalize(scene.camera.viewdir)), 0.999);
}

TEST(Composer, TellsWhereAndWhat) {
  const std::pair<std::string, std::string_view> cases[] = {
      {"Composer format 3.0 ascii",
       "1:16: expected version 2.1 or older of the format, as in \"Composer format 2.1 ascii\""},
      {"Composer format 2.1 ebcdic", "1:16: expected \"ascii\" or \"binary\" after the version"},
      {headed("spher"),
       "2:1: expected a camera, a light, a sphere or a poly_set, found \"spher\" [did you mean \"sphere\"?]"},
      {headed("sphere { origin 0 x 0 }"), "2:19: origin: expected a number, found \"x\""},
      {headed("poly_set { normType PER_CORNER }"),
       "2:21: normType: expected PER_VERTEX_NORMAL or PER_FACE_NORMAL, found \"PER_CORNER\""},
      {headed("camera {"), "2:9: camera: expected a word, found the end of the file"},
      {"Composer format 2.1 binary\nabcdefgh",
       "0:0: byte 31: expected the integer 123456789 in one of both byte orders"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(errorsOfFile(text), message) << text;
}

}  // namespace
}  // namespace trace::composer_format_test
