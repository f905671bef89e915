// What a scene may read, as the command says and obeys it.
#include <gtest/gtest.h>

#include <filesystem>

#include "image/codec.h"
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
