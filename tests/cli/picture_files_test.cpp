// Pictures on the standard streams, and files that other programs open.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "support/folder.h"
#include "support/paths.h"

namespace trace::test {
namespace {

class PictureFilesTest : public testing::Test {
 protected:
  /// Runs a line of a shell in the folder of the test; `ray` is the program. Returns the exit code.
  int shell(const std::string& line) const {
    const std::string all =
        "cd '" + folder_.path() + "' && ray() { '" + rayProgram() + "' \"$@\"; } && " + line;
    const int status = std::system(("bash -c '" + quoted(all) + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string text(const std::string& name) const { return readFile(folder_ / name); }
  const std::string scene_ = sourceFolder() + "/scenes/shapes.ray";
  const Folder folder_;

 private:
  static std::string quoted(const std::string& line) {
    std::string all;
    for (const char c : line) all += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return all;
  }
};

TEST_F(PictureFilesTest, GoToTheStandardOutput) {
  ASSERT_EQ(shell("ray " + scene_ + " -w 24 -o a.png 2> /dev/null && ray " + scene_ +
                  " -w 24 -o - > b.png 2> said"),
            0);
  EXPECT_EQ(text("a.png"), text("b.png")) << "the same bytes";
  EXPECT_NE(text("said").find("wrote the picture to the standard output"), std::string::npos) << text("said");
  ASSERT_EQ(shell("ray " + scene_ + " -w 24 -o - --format exr 2> /dev/null | cat > b.exr"), 0);
  EXPECT_EQ(readPicture(folder_ / "b.exr").width, 24);
  EXPECT_EQ(shell("ray " + scene_ + " -w 24 -o - --format txt > none 2> said"), 2);
  EXPECT_EQ(shell("ray " + scene_ + " -w 24 -o - --passes depth > none 2> said"), 2);
  EXPECT_EQ(text("none"), "");
  EXPECT_EQ(shell("ray " + scene_ + " -w 24 -o x.png --format exr 2> said"), 2);
}

TEST_F(PictureFilesTest, OfScenesFromTheStandardInput) {
  writeFile(folder_ / "a.ray",
            "SBT-raytracer 1.0\npoint_light { position = (0, 0, 9); color = (1, 1, 1); }\n"
            "sphere { material = { diffuse = (1, 0, 0); } }\n");
  for (const char* how :
       {"ray - -w 16 -o - < a.ray > b.png 2> said", "cat a.ray | ray - -w 16 -o - > c.png 2> said",
        "ray a.ray -w 16 -o - > d.png 2> said", "ray - -w 16 < a.ray 2> said"})
    ASSERT_EQ(shell(how), 0) << how << "\n" << text("said");
  EXPECT_EQ(readPicture(folder_ / "b.png"), readPicture(folder_ / "d.png"));
  EXPECT_EQ(text("b.png"), text("c.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "stdin.png"));
  EXPECT_EQ(shell("printf 'SBT-raytracer 1.0\\nsphere {' | ray - -o x.png 2> said"), 3);
  EXPECT_NE(text("said").find("-:2:"), std::string::npos) << "a message has the place: " << text("said");
}

TEST_F(PictureFilesTest, CommandsReadTheStandardInput) {
  writeFile(folder_ / "a.ray", "SBT-raytracer 1.0\nsphere {material={diffuse=(1,0,0);}}\n");
  ASSERT_EQ(shell("ray " + scene_ + " -w 16 -o a.png 2> said"), 0) << text("said");
  EXPECT_EQ(shell("ray diff a.png - < a.png > out 2> said"), 0) << text("said");
  EXPECT_EQ(text("out"), "a.png and - are identical (16x11)\n");
  EXPECT_EQ(shell("cat a.png | ray diff - a.png > out 2> said"), 0) << text("said");
  EXPECT_EQ(shell("ray diff - - < a.png > out 2> said"), 2);
  EXPECT_NE(text("said").find("expected at least one picture in a file, found - twice"), std::string::npos);
  for (const char* command : {"format", "expand"}) {
    ASSERT_EQ(shell(std::string("ray ") + command + " - < a.ray > b.ray 2> said"), 0) << text("said");
    ASSERT_EQ(shell(std::string("ray ") + command + " a.ray > c.ray 2> said"), 0);
    const std::string a = text("b.ray"), b = text("c.ray");
    EXPECT_EQ(a.substr(a.find("sphere")), b.substr(b.find("sphere"))) << command;
  }
  EXPECT_EQ(shell("ray format - --in-place < a.ray 2> said"), 2);
  EXPECT_NE(text("said").find("found the standard input"), std::string::npos) << text("said");
  ASSERT_EQ(shell("ray convert - b.obj < a.ray 2> said"), 0) << text("said");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "b.obj"));
}

/// Skips, by name and loudly, where a program is not installed.
#define TRACE_NEEDS_PROGRAM(name, package)           \
  if (shell("command -v " name " > /dev/null") != 0) \
  GTEST_SKIP() << "SKIPPED: needs " << name << " of Debian's " << package << "; ./dev setup all installs it"

class OtherProgramsTest : public PictureFilesTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(shell("ray " + scene_ +
                    " -w 40 --spp 4 -o all.exr --passes all --pass-format layers --alpha 2> said"),
              0)
        << text("said");
    ASSERT_EQ(shell("ray " + scene_ + " -w 40 -o part.exr --region 5,6,20,15 2> said"), 0) << text("said");
  }
  void expectEach(const std::string& file, std::initializer_list<const char*> words) const {
    const std::string said = text(file);
    for (const char* word : words) EXPECT_NE(said.find(word), std::string::npos) << word << " in " << said;
  }
};

TEST_F(OtherProgramsTest, IinfoReadsTheLayers) {
  TRACE_NEEDS_PROGRAM("iinfo", "openimageio-tools");
  ASSERT_EQ(shell("iinfo -v all.exr > said 2>&1"), 0) << text("said");
  expectEach("said",
             {"N.X", "P.Z", "albedo.R", "uv.U", "forward.u", "variance.Y", "direct.background.R",
              "indirect.other.B", "CryptoObject00.R", "CryptoMaterial02.A", "/manifest: ", "MurmurHash3_32"});
}

TEST_F(OtherProgramsTest, OiiotoolTakesALayerAndComposesOver) {
  TRACE_NEEDS_PROGRAM("oiiotool", "openimageio-tools");
  ASSERT_EQ(shell("oiiotool all.exr --ch R,G,B,A all.exr --ch R,G,B,A --over -o over.exr > said 2>&1"), 0)
      << text("said");
  ASSERT_EQ(shell("oiiotool all.exr --ch N.X,N.Y,N.Z -o n.exr > said 2>&1"), 0) << text("said");
  const Picture ours = readPicture(folder_ / "all.exr:N"), theirs = readPicture(folder_ / "n.exr:N");
  EXPECT_EQ(ours, theirs);
  ASSERT_EQ(shell("oiiotool --info -v part.exr > said 2>&1"), 0);
  expectEach("said", {"15 x    9", "full/display size: 40 x"});
}

TEST_F(OtherProgramsTest, ExrheaderReadsTheHeader) {
  TRACE_NEEDS_PROGRAM("exrheader", "openexr");
  ASSERT_EQ(shell("exrheader part.exr > said 2>&1"), 0) << text("said");
  expectEach("said",
             {"dataWindow (type box2i): (5 6) - (19 14)", "displayWindow (type box2i): (0 0) - (39 "});
  ASSERT_EQ(shell("exrheader all.exr > said 2>&1"), 0) << text("said");
  expectEach("said", {"cryptomatte/", "CryptoObject00.G, 32-bit floating-point", "Z, 32-bit floating-point"});
}

}  // namespace
}  // namespace trace::test
