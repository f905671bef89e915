// What a scene may read, as the command says and obeys it.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "image/codecs/codec.h"
#include "program.h"

namespace trace::reading_test {
namespace {

class CliReading : public testing::Test {
 protected:
  CliReading() {
    for (const char* name : {"home", "textures", "ref"}) std::filesystem::create_directories(folder_ / name);
    Picture red(4, 4);
    for (Color& pixel : red.pixels) pixel = Color(1, 0, 0);
    writePicture(folder_ / "textures/red.png", red);
    writePicture(folder_ / "ref/a.png", red);
    writeFile(folder_ / "home/a.ray",
              "SBT-raytracer 1.0\nambient_light { color = (1, 1, 1); }\nsphere {\n  material = { ambient = "
              "map(\"../textures/red.png\"); };\n}\n");
  }
  int run(const std::vector<std::string>& words) {
    test::Program program(folder_.path(), words);
    const int code = program.wait();
    said_ = program.err() + program.out();
    return code;
  }
  bool says(const std::string& part) const { return said_.find(part) != std::string::npos; }

  const test::Folder folder_;
  std::string said_;
};

TEST_F(CliReading, OneFlagLetsASceneReadItsTextures) {
  EXPECT_EQ(run({"home/a.ray", "out.png", "-w", "8"}), 3) << said_;
  EXPECT_TRUE(says("home/a.ray:4:")) << said_;
  EXPECT_TRUE(says("--allow-read home/../textures") || says("--allow-read textures")) << said_;
  EXPECT_EQ(run({"home/a.ray", "out.png", "-w", "8", "--allow-read", "ref", "--allow-read", "textures"}), 0)
      << said_;
  for (const char* command : {"info", "lint"})
    EXPECT_EQ(run({command, "home/a.ray", "--allow-read", "textures"}), 0) << command << said_;
  EXPECT_EQ(run({"convert", "home/a.ray", "home/b.ray", "--allow-read=textures"}), 0) << said_;
}

/// The flags that the last line of convert names are all that the result needs, from the same folder.
TEST_F(CliReading, ConvertSaysWhichFlagItsResultNeeds) {
  std::filesystem::create_directories(folder_ / "out/deep");
  const std::vector<std::string> outs{"out/deep/a.ray", "out/a.obj", "out/a.ply", "out/a.out", "home/b.ray"};
  for (const std::string& out : outs) {
    writeFile(folder_ / "home/a.ray",
              "SBT-raytracer 1.0\nambient_light { color = (1, 1, 1); }\nbox {\n  material = { diffuse = "
              "map(\"../textures/red.png\"); };\n}\n");
    EXPECT_EQ(run({"convert", "home/a.ray", out, "--allow-read", "textures"}), 0) << said_;
    const std::size_t begin = said_.find("; it names files outside its folder, which");
    ASSERT_NE(begin, said_.npos) << out << said_;
    std::istringstream words(said_.substr(begin));
    std::vector<std::string> flags;
    for (std::string word; words >> word;)
      if (word == "--allow-read") flags.push_back(word), words >> word, flags.push_back(word);
    EXPECT_EQ(flags.size(), 2u) << said_;
    run({"info", out});
    EXPECT_TRUE(says("is outside the scene's folder")) << out << said_;
    std::vector<std::string> info{"info", out};
    info.insert(info.end(), flags.begin(), flags.end());
    EXPECT_EQ(run(info), 0) << said_;
    EXPECT_FALSE(says("is outside the scene's folder")) << out << said_;
  }
}

TEST_F(CliReading, ConvertIsSilentWhereNoFlagIsNeeded) {
  std::filesystem::create_directories(folder_ / "home/below");
  writePicture(folder_ / "home/below/red.png", Picture(2, 2));
  writeFile(folder_ / "home/c.ray",
            "SBT-raytracer 1.0\nbox { material = { diffuse = map(\"below/red.png\"); }; }\n");
  EXPECT_EQ(run({"convert", "home/c.ray", "home/d.ray"}), 0) << said_;
  EXPECT_FALSE(says("allow-read")) << said_;
}

TEST_F(CliReading, ASceneCannotAllowItself) {
  writeFile(folder_ / "home/b.ray",
            "SBT-raytracer 1.0\nsettings { allow-read = \"..\"; backdrop = \"../textures/red.png\"; "
            "}\nsphere { }\n");
  EXPECT_EQ(run({"home/b.ray", "out.png", "-w", "8"}), 3) << said_;
}

TEST_F(CliReading, WhatTheCommandLineNamesIsAllowed) {
  writeFile(folder_ / "home/b.ray",
            "SBT-raytracer 1.0\nsettings { backdrop = \"../textures/red.png\"; }\nsphere { }\n");
  EXPECT_EQ(run({"home/b.ray", "out.png", "-w", "8"}), 3) << said_;
  EXPECT_TRUE(says("home/b.ray:2:")) << said_;
  EXPECT_EQ(run({"home/b.ray", "out.png", "-w", "8", "--backdrop", "textures/red.png"}), 0) << said_;
}

TEST_F(CliReading, NoGradedSceneReadsTheReferences) {
  std::filesystem::create_symlink("../ref/a.png", folder_ / "home/own.png");
  for (const char* picture : {"../ref/a.png", "own.png"}) {
    writeFile(folder_ / "home/a.ray",
              std::string("SBT-raytracer 1.0\nsettings { width = 4; height = 4; backdrop = \"") + picture +
                  "\"; }\n");
    EXPECT_EQ(run({"grade", "home", "--reference", "ref", "--render", "--allow-read", "."}), 6) << said_;
    EXPECT_TRUE(says("unreadable")) << said_;
    EXPECT_FALSE(says("identical")) << said_;
  }
}

}  // namespace
}  // namespace trace::reading_test
