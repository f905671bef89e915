// Edits of texts that use the language of scenes, and of those that begin with `Trace 1`: what an edit
// changes are literals in their places; names, loops, comments and what Trace completes stay.
#include "formats/ray_patch_helpers.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/materials/phong.h"

namespace trace::test {
namespace {

constexpr const char* kText = R"(Trace 1
// words
let red = (0.8, 0.1, 0.1)
let r = 0.5
settings { width = 120; quality = draft }   // small
camera { position = (0, 2, 6); look_at = (0, 0.5, 0) }
plane { material = { library = oak } }  // the floor
translate(0, r, 0) { sphere { name = "ball"; material = { diffuse = red } } }
translate (1.5, 0.5, 0) { rotate y 30 { box { name = "cube"; material = { model = lambert; diffuse = (0.2, 0.3, 2 * 0.4) } } } }
for i in 0..3 {
  translate(i - 1.5, 0.25, -2) { scale(0.25) { sphere { material = { library = gold } } } }  // a row
}
point_light { name = "lamp"; position = (2, 4, 3); power = 60 }
)";

Object& called(Scene& scene, const std::string& name) {
  for (Object& object : scene.objects)
    if (object.name == name) return object;
  throw std::runtime_error("there is no " + name);
}

/// The lines that the edit of kText takes out, and those that it brings, with "-" and "+" before them; and
/// what was said.
std::string change(const Edit& edit, const std::string& text = kText) {
  const SceneText read = reading("test.ray", text);
  Scene scene = *read.scene;
  edit(scene);
  const Saved result = saved(read, scene);
  expectSays(read, result.text, scene, result.text);
  const std::vector<std::string> a = linesOf(text), b = linesOf(result.text);
  std::string lines;
  for (const std::string& line : a)
    if (std::find(b.begin(), b.end(), line) == b.end()) lines += "-" + line + "\n";
  for (const std::string& line : b)
    if (std::find(a.begin(), a.end(), line) == a.end()) lines += "+" + line + "\n";
  for (const Message& message : result.messages) lines += message.what + "\n";
  return lines;
}

TEST(RayPatchLanguage, LiteralsChangeInPlace) {
  EXPECT_EQ(change([](Scene& s) {
              Object& cube = called(s, "cube");
              cube.worldFromObject = Affine::translation({0, 0, 0.7}) * cube.worldFromObject;
            }),
            "-translate (1.5, 0.5, 0) { rotate y 30 { box { name = \"cube\"; material = { model = lambert; "
            "diffuse = (0.2, "
            "0.3, 2 * 0.4) } } } }\n"
            "+translate (1.5, 0.5, 0.7) { rotate y 30 { box { name = \"cube\"; material = { model = lambert; "
            "diffuse = "
            "(0.2, 0.3, 2 * 0.4) } } } }\n");
  EXPECT_EQ(change([](Scene& s) { s.lights[0].light.edit<PointLight>()->position.x = 1; }),
            "-point_light { name = \"lamp\"; position = (2, 4, 3); power = 60 }\n"
            "+point_light { name = \"lamp\"; position = (1, 4, 3); power = 60 }\n");
  EXPECT_EQ(change([](Scene& s) {
              s.choices.push_back({"width", "90", {}});
            }),
            "-settings { width = 120; quality = draft }   // small\n"
            "+settings { width = 90; quality = draft }   // small\n");
  EXPECT_EQ(change([](Scene& s) { called(s, "cube").name = "die"; }).substr(0, 12), "-translate (");
}

TEST(RayPatchLanguage, TheSpinOfAnObjectIsInDegrees) {
  const std::string lines = change([](Scene& s) {
    Object& cube = called(s, "cube");
    cube.worldFromObject = Affine::translation({1.5, 0.5, 0}) * Affine::rotation({0, 1, 0}, 45 * kPi / 180);
  });
  EXPECT_NE(lines.find("rotate y 45 {"), std::string::npos) << lines;
}

TEST(RayPatchLanguage, WhatANameOrAnExpressionGivesIsReplacedAndTold) {
  EXPECT_EQ(change([](Scene& s) {
              Object& ball = called(s, "ball");
              s.materials[ball.material].model.edit<Phong>()->diffuse = {0, 1, 0};
            }),
            "-translate(0, r, 0) { sphere { name = \"ball\"; material = { diffuse = red } } }\n"
            "+translate(0, r, 0) { sphere { name = \"ball\"; material = { diffuse = (0, 1, 0) } } }\n"
            "\"red\" is replaced by what was typed for it here\n");
}

TEST(RayPatchLanguage, ALampInWattsGetsItsColour) {
  const std::string lines = change([](Scene& s) {
    s.lights[0].light.edit<PointLight>()->color = {1, 0.5, 0.2};
  });
  EXPECT_NE(lines.find("+point_light { name = \"lamp\"; position = (2, 4, 3); power = 39.478"),
            std::string::npos)
      << lines;
}

TEST(RayPatchLanguage, OneObjectOfALoopIsWrittenByItself) {
  const std::string lines = change([](Scene& s) {
    Object& second = s.objects.at(s.objects.size() - 2);
    second.worldFromObject = Affine::translation({0, 1, 0}) * second.worldFromObject;
  });
  EXPECT_NE(lines.find("the objects that this makes are written one by one"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("-let"), std::string::npos) << lines;
}

TEST(RayPatchLanguage, WhatTraceCompletesIsSaidOnceItWouldChange) {
  const std::string text = "Trace 1\n// a ball\ntranslate(0, 1, 0) { sphere { } }\nplane { }\n";
  const auto keeps = [&](const std::string& lines) {
    EXPECT_FALSE(lines.starts_with('-') || lines.find("\n-") != std::string::npos) << lines;
    EXPECT_EQ(lines.find("rewritten"), std::string::npos) << lines;
  };
  keeps(change([](Scene& s) { s.camera.position = {0, 3, 9}; }, text));
  keeps(change([](Scene& s) { s.lights[0].light.edit<DirectionalLight>()->color = {1, 0, 0}; }, text));
  keeps(change([](Scene& s) { s.choices.push_back({"spp", "3", {}}); }, text));
  keeps(change([](Scene& s) { s.choices.push_back({"integrator", "whitted", {}}); }, text));
  keeps(change(
      [](Scene& s) {
        s.lights.push_back({PointLight{.position = {1, 4, 2}, .color = {3, 3, 3}}, {}});
      },
      text));
}

TEST(RayPatchLanguage, AnOptionThatItsQualityHidesIsNamed) {
  EXPECT_EQ(change([](Scene& s) {
              s.choices.push_back({"integrator", "whitted", {}});
            }),
            "-settings { width = 120; quality = draft }   // small\n"
            "+settings { width = 120; quality = draft; integrator = whitted; }   // small\n");
}

TEST(RayPatchLanguage, EveryExampleKeepsItsTextWhenTheCameraMoves) {
  std::size_t tried = 0;
  for (const std::string& file : filesUnder(sourceFolder() + "/scenes", ".ray")) {
    const std::string bytes = readFile(file);
    if (!recognisesRay(bytes)) continue;
    const SceneText read = reading(file, bytes);
    Scene scene = *read.scene;
    scene.camera.position += Vec3{0.5, 0.25, 0.125};
    Messages messages;
    const Rewritten rewritten = rewriteRay(read, scene, file, messages);
    EXPECT_EQ(rewritten.files.size(), 1u) << file;
    EXPECT_TRUE(rewritten.keepsAll || bytes.find("position = key(") != bytes.npos) << file;
    EXPECT_EQ(commentsIn(rewritten.files.at(0).bytes), commentsIn(bytes)) << file;
    ++tried;
  }
  EXPECT_GT(tried, 80u);
}

}  // namespace
}  // namespace trace::test
