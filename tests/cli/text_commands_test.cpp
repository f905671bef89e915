// ray new, ray format, ray expand and ray materials.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string_view>

#include "formats/format.h"
#include "formats/ray/file/format.h"
#include "formats/ray/language/expansion.h"
#include "formats/ray/syntax/layout.h"
#include "image/codecs/codec.h"
#include "program.h"
#include "support/paths.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

/// Every .ray file of scenes/.
std::vector<std::string> allScenes() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(test::sourceFolder() + "/scenes"))
    if (entry.path().extension() == ".ray" && recognisesRay(readFile(entry.path().string())))
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  EXPECT_GT(files.size(), 60u);
  return files;
}

/// What is rendered is the same, wherever the text of it stands.
bool sameScene(const Scene& a, const Scene& b) {
  const auto same = [](const auto& x, const auto& y, auto&& isSame) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), isSame);
  };
  return a.camera == b.camera && a.background == b.background && a.materials == b.materials &&
         same(a.lights, b.lights,
              [](const LightSource& x, const LightSource& y) {
                return x.light == y.light && x.links == y.links;
              }) &&
         same(a.objects, b.objects,
              [](const Object& x, const Object& y) {
                return x.name == y.name && x.shape == y.shape && x.worldFromObject == y.worldFromObject &&
                       x.material == y.material && x.links == y.links;
              }) &&
         same(a.choices, b.choices,
              [](const Choice& x, const Choice& y) { return x.option == y.option && x.value == y.value; });
}

TEST(Layout, OfEverySceneIsStableAndKeepsItsMeaning) {
  for (const std::string& file : allScenes()) {
    const std::string once = tidied(file, readFile(file));
    EXPECT_EQ(tidied(file, once), once) << file;
    Messages messages;
    EXPECT_TRUE(sameScene(readScene(file, readFile(file), messages), readScene(file, once, messages)))
        << file;
  }
}

TEST(Layout, TidiesAndKeepsComments) {
  const std::string text =
      "SBT-raytracer 1.0\r\n\n\n\n// head\nlet n=3   // how many\nlet longer = 2 * n - 1 // odd\n"
      "translate( 1,2 , 3 ){ sphere{}}\n"
      "for i in 0..n { box{ name=\"a  b\" ;material={diffuse=(1,0 ,0);} }  /* two\n   lines */\n"
      "      if (i==2) {cone{ }\n } }\n\n}\n";
  // One closing bracket too many: an error, and nothing is guessed.
  EXPECT_THROW(tidied("a.ray", text), Error);
  EXPECT_EQ(tidied("a.ray", text.substr(0, text.size() - 3)),
            "SBT-raytracer 1.0\n"
            "\n"
            "// head\n"
            "let n = 3               // how many\n"
            "let longer = 2 * n - 1  // odd\n"
            "translate(1, 2, 3) { sphere { } }\n"
            "for i in 0..n {\n"
            "  box { name = \"a  b\"; material = { diffuse = (1, 0, 0); } } /* two\n   lines */\n"
            "  if (i==2) {\n"
            "    cone { }\n"
            "  }\n"
            "}\n");
}

TEST(Layout, LeavesBlanksThatMeanSomething) {
  const std::string text =
      "SBT-raytracer 1.1\nlet a = (1 -2 3)\nlet b = 4 - 2\nlet c = (a[1] 2)\nlet d = 1e-5\n";
  EXPECT_EQ(tidied("a.ray", text), text);
}

bool isOneOf(const std::string& file, std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return file.ends_with(name); });
}

TEST(Expansion, OfEverySceneIsTheSameScene) {
  int expanded = 0;
  for (const std::string& file : allScenes()) {
    if (isOneOf(file, {"forest.ray", "city.ray"})) continue;  // they have up to a million instances
    const std::string text = readFile(file), plain = expansionOf(file, text, 0).text;
    Messages messages;
    EXPECT_TRUE(sameScene(readScene(file, text, messages), readScene(file, plain, messages))) << file;
    expanded += plain.find("\nlet ") == std::string::npos && text.find("\nlet ") != std::string::npos;
  }
  EXPECT_GE(expanded, 4) << "scenes that use the language";
}

TEST(Expansion, SaysWhatMadeAnObject) {
  const std::string text =
      "Trace 1\ndefine ball(r) { scale(r) { sphere { } } }\nfor i in 1..2 { translate(i / 3, 0, 0) { ball(i) "
      "} }\n";
  EXPECT_EQ(
      expansionOf("a.ray", text, 0).text,
      "Trace 1\n"
      "\n// a.ray:3, in i = 1 at a.ray:3:1\n"
      "translate(0.3333333333333333, 0, 0, {\n  {\n    scale(1, {\n      sphere { }\n    });\n  }\n});\n"
      "\n// a.ray:3, in i = 2 at a.ray:3:1\n"
      "translate(0.6666666666666666, 0, 0, {\n  {\n    scale(2, {\n      sphere { }\n    });\n  }\n});\n");
}

using TextCommands = ProgramTest;

TEST_F(TextCommands, ExpandedScenesRenderTheSamePicture) {
  for (const char* name : {"gears", "chess", "fractal-tree", "spiral-stairs"}) {
    const std::string scene = test::sourceFolder() + "/scenes/" + name + ".ray";
    EXPECT_EQ(run({"expand", scene, "-o", "plain.ray"}).code, 0);
    const std::vector<std::string> small{"-w",           "24",      "--spp",       "1",
                                         "--integrator", "whitted", "--subdivide", "0"};
    const auto render = [&](const std::string& file, const std::string& picture) {
      std::vector<std::string> words{file, picture};
      words.insert(words.end(), small.begin(), small.end());
      EXPECT_EQ(run(words).code, 0) << file;
      return readPicture(path(picture)).pixels;
    };
    EXPECT_EQ(render(scene, "a.exr"), render("plain.ray", "b.exr")) << name;
  }
  EXPECT_NE(run({"expand", test::sourceFolder() + "/scenes/gears.ray"}).err.find("changes with time"),
            std::string::npos);
  EXPECT_EQ(run({"expand", test::sourceFolder() + "/scenes/meshes/ring.off"}).code, 3);
}

TEST_F(TextCommands, ExpandFindsFilesFromElsewhere) {
  fs::create_directory(path("in"));
  fs::create_directory(path("out"));
  writeFile(path("in/m.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  writeFile(path("in/part.ray"), "let half = 1 / 2\n");
  writeFile(path("in/s.ray"), "Trace 1\ninclude \"part.ray\"\nscale(half) { mesh { file = \"m.off\" } }\n");
  EXPECT_EQ(run({"expand", "in/s.ray", "-o", "out/s.ray"}).code, 0);
  EXPECT_NE(readFile(path("out/s.ray")).find("\"../in/m.off\""), std::string::npos)
      << readFile(path("out/s.ray"));
  EXPECT_EQ(readFile(path("out/s.ray")).find("include"), std::string::npos);
  EXPECT_EQ(run({"expand", "in/s.ray", "-o", "in/part.ray"}).code, 2) << "an included file is no output";
}

TEST_F(TextCommands, FormatPrintsOrWritesBack) {
  const std::string untidy = "SBT-raytracer 1.0\nsphere{}\n", tidy = "SBT-raytracer 1.0\nsphere { }\n";
  writeFile(path("s.ray"), untidy);
  EXPECT_EQ(run({"format", "s.ray"}).out, tidy);
  EXPECT_EQ(readFile(path("s.ray")), untidy);
  EXPECT_EQ(run({"format", "s.ray", "-o", "t.ray"}).code, 0);
  EXPECT_EQ(readFile(path("t.ray")), tidy);
  EXPECT_EQ(run({"format", "s.ray", "-o", "s.ray"}).code, 2);
  EXPECT_EQ(run({"format", "--in-place", "s.ray"}).code, 0);
  EXPECT_EQ(readFile(path("s.ray")), tidy);
  EXPECT_NE(run({"format", "-i", "s.ray"}).err.find("is tidy"), std::string::npos);
  writeFile(path("wrong.ray"), "SBT-raytracer 1.0\nsphere {\n");
  EXPECT_EQ(run({"format", "-i", "wrong.ray"}).code, 3);
  EXPECT_EQ(readFile(path("wrong.ray")), "SBT-raytracer 1.0\nsphere {\n");
}

TEST_F(TextCommands, NewWritesASceneThatIsSoundAndOverwritesNothing) {
  const auto written = run({"new", "first"});
  EXPECT_EQ(written.code, 0) << written.err;
  EXPECT_NE(written.err.find("wrote first.ray; next: ray first.ray"), std::string::npos) << written.err;
  const std::string text = readFile(path("first.ray"));
  EXPECT_TRUE(text.starts_with("Trace 1\n"));
  EXPECT_NE(text.find("`ray first.ray` renders it"), text.npos) << "its comment names its own file";
  EXPECT_EQ(text.find("scene.ray"), text.npos);
  EXPECT_EQ(tidied("first.ray", text), text) << "a first scene is tidy";
  EXPECT_EQ(run({"lint", "first.ray"}).code, 0) << run({"lint", "first.ray"}).out;
  EXPECT_EQ(run({"new", "first.ray"}).code, 2);
  EXPECT_EQ(run({"new"}).code, 0);
  EXPECT_TRUE(fs::exists(path("scene.ray")));
  EXPECT_EQ(run({"new", "first.png"}).code, 2);
  EXPECT_EQ(run({"first.ray", "first.png", "-w", "32", "--quality", "draft"}).code, 0);
}

TEST_F(TextCommands, MaterialsAreListedAndShown) {
  const std::string all = run({"materials"}).out;
  for (const char* name : {"metal\n", "  gold ", "  red granite ", "  water ", "  BK7 "})
    EXPECT_NE(all.find(name), std::string::npos) << name;
  EXPECT_EQ(run({"materials", "gold"}).out, "gold: metal, polished\n");
  EXPECT_NE(run({"materials", "goold"}).err.find("did you mean \"gold\"?"), std::string::npos);
  EXPECT_EQ(run({"materials", "gold", "-o", "ball.png", "--size", "24x24"}).code, 0);
  const Picture ball = readPicture(path("ball.png"));
  ASSERT_EQ(ball.width, 24);
  const Color middle = ball.at(12, 10);
  EXPECT_GT(middle.r, 1.3 * middle.b) << "gold is yellow";
}

}  // namespace
}  // namespace trace::test
