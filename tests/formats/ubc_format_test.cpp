// Scenes of British Columbia: what each command means, in Trace's terms.
#include "formats/ubc/ubc_format.h"

#include "geometry/mesh/mesh.h"
#include "mesh_helpers.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/point_light.h"

namespace trace::ubc_format_test {
namespace {

const Phong& phongAt(const Scene& scene, std::size_t object) {
  return *scene.materials.at(scene.objects.at(object).material).model.as<Phong>();
}
std::string choiceOf(const Scene& scene, std::string_view option) {
  std::string value;
  for (const Choice& choice : scene.choices)
    if (choice.option == option) value = choice.value;
  return value;
}

TEST(Ubc, IsRecognisedByItsCommands) {
  EXPECT_TRUE(recognisesUbc("# comment\r\n\r\n  Dimensions 640 480"));
  EXPECT_TRUE(recognisesUbc("Resolution 640 480"));
  EXPECT_TRUE(recognisesUbc("Dimension 1 2\nSphere 1 \"a\"\nScale 1 1 1")) << "the first is misspelt";
  EXPECT_FALSE(recognisesUbc("SBT-raytracer 1.0\nsphere {}"));
  EXPECT_FALSE(recognisesUbc("# Sphere\nv 1 2 3"));
}

TEST(Ubc, TakesThePictureAndTheCameraAsWritten) {
  const Scene scene = sceneIn(
      "Dimensions 640.9 480 Perspective 30 1.33 3 20\nLookAt 1 2 3  1 2 -7  0 2 1 Material \"m\" Sphere 1 "
      "\"m\"");
  EXPECT_EQ(scene.format, "ubc");
  EXPECT_EQ(choiceOf(scene, "width"), "640");
  EXPECT_EQ(choiceOf(scene, "height"), "480");
  EXPECT_EQ(choiceOf(scene, "depth"), "9");
  EXPECT_EQ(choiceOf(scene, "like"), "ubc");
  EXPECT_EQ(scene.camera.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.camera.viewdir, (Vec3{0, 0, -1}));
  EXPECT_EQ(scene.camera.updir, (Vec3{0, 2, 1}));
  EXPECT_EQ(scene.camera.fov, 30);
  EXPECT_EQ(scene.camera.aspectratio, 1.33);
  EXPECT_EQ(scene.camera.near, 3);
  EXPECT_EQ(scene.camera.far, 20);
}

TEST(Ubc, HasDefaultsWithoutCommands) {
  const Scene scene = sceneIn("Material \"m\" Sphere 1 \"m\"");
  EXPECT_EQ(choiceOf(scene, "width"), "640");
  EXPECT_EQ(choiceOf(scene, "height"), "640");
  EXPECT_EQ(scene.camera.viewdir, (Vec3{0, 0, 1}));
  EXPECT_EQ(scene.camera.fov, 45);
  EXPECT_EQ(scene.camera.far, 10000);
}

TEST(Ubc, MaterialsAreCopiedWhereTheyAreNamed) {
  const Scene scene = sceneIn(
      "Material \"m\" \"ambient\" [1 0 0] \"diffuseColor\" [2 2 2] \"specular\" [0 1 0] \"emission\" [0 0 "
      "1]\n"
      "\"shininess\" 50 \"shadow\" [0.7] \"reflect\" .25 Sphere 1 \"m\"\n"
      "Material \"m\" \"diffuse\" [1 1 1] Sphere 2 \"m\"");
  const Phong& a = phongAt(scene, 0);
  EXPECT_EQ(a.ambient, Color(1, 0, 0));
  EXPECT_EQ(a.diffuse, Color(2));
  EXPECT_EQ(a.specular, Color(0, 1, 0));
  EXPECT_EQ(a.emissive, Color(0, 0, 1));
  EXPECT_EQ(a.reflective, Color(0.25));
  EXPECT_EQ(a.shininess, 50);
  EXPECT_EQ(a.shadow, 0.7);
  EXPECT_FALSE(a.mirrorsSpecular);
  EXPECT_EQ(phongAt(scene, 1).diffuse, Color(1));
  EXPECT_EQ(phongAt(scene, 1).shadow, 0) << "a key that is missing is 0";
}

TEST(Ubc, WithoutAnyShadowKeyShadowsAreBlack) {
  EXPECT_EQ(phongAt(sceneIn("Material \"m\" Sphere 1 \"m\""), 0).shadow, 1);
}

TEST(Ubc, ReadsTheGlassOfStudents) {
  const auto glass = [](const std::string& keys) {
    const Scene scene = sceneIn("Material \"m\" " + keys + " Sphere 1 \"m\"");
    return std::pair{phongAt(scene, 0).transmissive.r, phongAt(scene, 0).index};
  };
  EXPECT_EQ(glass("\"refract\" 0.5 \"rfrIndex\" 1.33"), (std::pair{0.5, 1.33}));
  EXPECT_EQ(glass("\"refract\" 1.5 \"transparent\" 1"), (std::pair{1.0, 1.5}));
  EXPECT_EQ(glass("\"refract\" 1.0 \"transparency\" 0"), (std::pair{0.0, 1.0}));
  EXPECT_EQ(glass("\"refract\" 0.0 \"transparency\" 0"), (std::pair{0.0, 1.0}));
}

TEST(Ubc, MatricesMultiplyOnTheRight) {
  const Scene scene = sceneIn(
      "Material \"m\" PushMatrix Translate 1 0 0 Rotate 90 0 0 1 Scale 2 1 1 Sphere [0.5] \"m\" PopMatrix "
      "Plane \"m\"");
  const Vec3 p = scene.objects[0].worldFromObject * Vec3{1, 0, 0};
  EXPECT_NEAR(p.x, 1, 1e-15);
  EXPECT_NEAR(p.y, 1, 1e-15);
  EXPECT_EQ(scene.objects[1].worldFromObject, Affine{});
}

TEST(Ubc, MeshesAreFlatAndTwoSided) {
  const Scene scene =
      sceneIn("Material \"m\" Mesh \"m\" [3 4] [0 1 2 0 1 2 3] \"P\" [0 0 0 1 0 0 1 1 0 0 1 0]");
  const MeshData& mesh = meshOf(scene);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(mesh.twoSided);
  EXPECT_TRUE(mesh.normals.empty());
}

TEST(Ubc, LightsHaveAnAmbientPartAndHighlightsOfTheirOwn) {
  const Scene scene = sceneIn(
      "PointLight 1 2 3 \"ambient\" [0.1 0.2 0.3] \"diffuse\" [8 8 12] \"specular\" [20 20 20] "
      "\"attenuation\" [1.8 3 0.5]\nPointLight 0 0 0 Material \"m\" Sphere 1 \"m\"");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].light.as<AmbientLight>()->color, Color(0.1, 0.2, 0.3));
  const auto& light = *scene.lights[1].light.as<PointLight>();
  EXPECT_EQ(light.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(light.color + light.extraHighlight, Color(20));
  EXPECT_EQ((Vec3{light.constant, light.linear, light.quadratic}), (Vec3{1.8, 3, 0.5}));
  EXPECT_EQ(scene.lights[2].light.as<PointLight>()->constant, 1) << "no attenuation at all";
}

TEST(Ubc, TellsWhereAndWhat) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"Dimensions 640 480\nSpher 1 \"m\"",
       "2:1: expected a command, found \"Spher\" [did you mean \"Sphere\"?]"},
      {"Sphere 1 \"m\"", "1:10: expected the name of a material, found the text \"m\""},
      {"Material \"red\"\nSphere 1 \"rde\"",
       "2:10: expected the name of a material, found the text \"rde\" [did you mean \"red\"?]"},
      {"Material \"m\" \"diffuse\" [1 1]", "1:14: diffuse: expected 3 numbers, found 2"},
      {"Material \"m\" \"shininess\" \"hard\"", "1:14: shininess: expected 1 number, found text"},
      {"Dimensions 640 480\nPopMatrix", "2:1: PopMatrix without a PushMatrix before it"},
      {"Dimensions 640 x", "1:16: Dimensions: expected a number, found \"x\""},
      {"Dimensions 0 480", "1:12: Dimensions: expected 1 to 100000 pixels"},
      {"Translate 1 2", "1:14: Translate: expected a number, found the end of the file"},
      {"Material \"m", "1:10: expected a closing quote, found the end of the file"},
      {"Sphere 1e999 \"m\"", "1:8: expected a finite number, found \"1e999\""},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(errorsOfFile(text), message) << text;
  EXPECT_EQ(errorsOfFile("Material \"m\"\nMesh \"m\" \"none.obj\"").substr(0, 5), "2:10:");
}

TEST(Ubc, WarnsOfKeysItDoesNotKnow) {
  EXPECT_EQ(warningsOfFile("Material \"m\" \"difuse\" [1 1 1]\nSphere 1 \"m\""),
            "1:14: \"difuse\" of a material is ignored [did you mean \"diffuse\"?]");
}

TEST(Ubc, ReadsItsPredecessor) {
  const Scene scene = sceneIn(
      "Resolution 320 240\nCamera 0 0 5 0 0 0 0 1 0 40 1.33 1 50\n"
      "Material 1 1 0 0 1 0 0 1 1 1 0 0 0 500 0.4 0.25\nSphere 2 1 2 3 1\nPlane 0 2 0 3 1\n"
      "PointLight 1 2 3 .1 .1 .1 10 10 10 20 20 20 1.8 3 0");
  EXPECT_EQ(choiceOf(scene, "width"), "320");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].worldFromObject * Vec3(0, 0, 1), (Vec3{1, 2, 5}));
  EXPECT_NEAR((scene.objects[1].worldFromObject * Vec3{}).y, -1.5, 1e-15);
  EXPECT_NEAR(linear(scene.objects[1].worldFromObject, {0, 0, 1}).y, 1, 1e-15);
  const Phong& phong = phongAt(scene, 0);
  EXPECT_EQ(phong.diffuse, Color(0.75, 0, 0)) << "reflection blends";
  EXPECT_EQ(phong.reflective, Color(0.25));
  EXPECT_EQ(phong.shadow, 0.4);
}

}  // namespace
}  // namespace trace::ubc_format_test
