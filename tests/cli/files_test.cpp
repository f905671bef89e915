// Nothing a user has is lost: inputs that stay, pictures that stay whole, streams that are closed, names that
// would command a terminal.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "image/codecs/codec.h"
#include "program.h"

namespace trace::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class FilesTest : public ProgramTest {
 protected:
  void writeGrey(const std::string& name, double level) const {
    Picture picture(4, 4);
    for (Color& c : picture.pixels) c = Color(level);
    writePicture(path(name), picture);
  }
  std::string bytesOf(const std::string& name) const { return readFile(path(name)); }

  /// The command must refuse to write over the file, and does.
  void expectRefused(const std::vector<std::string>& words, const std::string& file, int code = 2) const {
    const std::string before = bytesOf(file);
    const Run r = run(words);
    EXPECT_EQ(r.code, code) << words[0] << " " << words[1] << "\n" << r.err;
    EXPECT_TRUE(contains(r.err, "it is not written over") || contains(r.err, "inputs are not overwritten") ||
                contains(r.err, "expected a page"))
        << r.err;
    EXPECT_FALSE(contains(r.last, "the command line is not right")) << "a name was refused, no word";
    EXPECT_EQ(bytesOf(file), before) << words[0] << " " << words[1];
  }

  /// A land of a height map, a mesh with materials and a texture.
  void writeScenes() const {
    writeGrey("land.png", 0.5);
    writeGrey("duck.png", 0.5);
    write("duck.mtl", "newmtl skin\nmap_Kd duck.png\n");
    write("duck.obj", "mtllib duck.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n");
    write("land.ray",
          std::string(kWhite) + "height_field { file = \"land.png\"; } mesh { file = \"duck.obj\"; }");
  }

  /// Runs through a shell, in the folder; `ray` is the program.
  int shell(const std::string& command) const {
    const std::string line = "cd '" + folder() + "' && ray() { '" + rayProgram() + "' \"$@\"; }; " + command;
    const int status = std::system(("bash -c \"" + escaped(line) + "\"").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  static std::string escaped(const std::string& line) {
    std::string result;
    for (const char c : line)
      result += c == '"' || c == '$' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return result;
  }
};

TEST_F(FilesTest, InputsAreNoOutputs) {
  writeScenes();
  expectRefused({"land.ray", "-w", "8"}, "land.png");  // by the default name
  expectRefused({"duck.obj", "-w", "8"}, "duck.png");
  expectRefused({"land.ray", "duck.png", "-w", "8"}, "duck.png");
  fs::create_directory(path("sub"));
  fs::create_hard_link(path("land.png"), path("sub/hard.png"));
  for (const char* name : {"./sub/../land.png", "sub/hard.png"})
    expectRefused({"land.ray", name, "-w", "8"}, "land.png");
}

TEST_F(FilesTest, InputsAreNoOutputsOfAnyCommand) {
  writeScenes();
  fs::copy_file(path("land.png"), path("x.0001.png"));
  write("frames.ray", std::string(kWhite) + "height_field { file = \"x.0001.png\"; }");
  expectRefused({"render", "frames.ray", "--frames", "0-2", "-w", "8", "-o", "x.####.png"}, "x.0001.png");
  EXPECT_FALSE(exists("x.0000.png"));

  fs::copy_file(path("land.png"), path("y.depth.png"));
  write("pass.ray", std::string(kWhite) + "height_field { file = \"y.depth.png\"; }");
  expectRefused({"pass.ray", "y.png", "-w", "8", "--passes", "depth", "--pass-format", "png"}, "y.depth.png");

  expectRefused({"convert", "duck.obj", "duck.obj"}, "duck.obj");
  expectRefused({"convert", "land.ray", "duck.obj"}, "duck.obj");
}

TEST_F(FilesTest, ConvertSparesTheMaterialsToo) {
  writeScenes();
  fs::rename(path("duck.obj"), path("bird.obj"));  // so that duck.obj, with duck.mtl beside it, is free
  const std::string before = bytesOf("duck.mtl");
  EXPECT_EQ(run({"convert", "bird.obj", "duck.obj"}).code, 0);
  EXPECT_EQ(bytesOf("duck.mtl"), before);
  EXPECT_TRUE(exists("duck.obj") && exists("duck-2.mtl"));
}

TEST_F(FilesTest, ExplainLintDiffAndGradeSpareThem) {
  writeScenes();
  expectRefused({"explain", "land.ray", "--pixel", "1,1", "-w", "8", "-o", "land.png"}, "land.png");
  expectRefused({"explain", "land.ray", "--pixel", "1,1", "-w", "8", "-o", "duck.obj"}, "duck.obj");
  expectRefused({"lint", "land.ray", "-o", "duck.mtl"}, "duck.mtl");
  writeGrey("a.png", 0.1), writeGrey("b.png", 0.2);
  fs::create_symlink("b.png", path("c.png"));
  expectRefused({"diff", "a.png", "b.png", "-o", "c.png"}, "b.png");
  fs::create_directories(path("out")), fs::create_directories(path("ref"));
  writeGrey("out/a.png", 0.5), writeGrey("ref/a.png", 0.5), writeGrey("out/extra.png", 0.5);
  for (const char* file : {"out/a.png", "ref/a.png", "out/extra.png"})
    expectRefused({"grade", "out", "--reference", "ref", "-o", file}, file);
  EXPECT_EQ(run({"grade", "out", "--reference", "ref", "-o", "out/page.html"}).code, 0);
  EXPECT_EQ(run({"grade", "out", "--reference", "ref", "-o", "out/page.html"}).code, 0);  // again
}

TEST_F(FilesTest, GradeSparesWhatItsScenesRead) {
  fs::create_directories(path("out")), fs::create_directories(path("ref"));
  writeGrey("land.png", 0.5), writeGrey("ref/a.png", 0.5);
  write("out/a.ray", std::string(kWhite) + "height_field { file = \"../land.png\"; }");
  expectRefused(
      {"grade", "out", "--reference", "ref", "--render", "--allow-read", ".", "-w", "8", "-o", "land.png"},
      "land.png");
}

TEST_F(FilesTest, AReadOnlyPictureIsRefusedBeforeRendering) {
  writeGrey("out.png", 0.5);
  fs::permissions(path("out.png"), fs::perms::owner_read);
  const std::string before = bytesOf("out.png");
  const Run r = run({"white.ray", "out.png", "-w", "8"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "\"out.png\": it is read-only"));
  EXPECT_EQ(bytesOf("out.png"), before);
}

TEST_F(FilesTest, ThreadsLeaveNoTrace) {
  for (const char* format : {".png", ".exr", ".jpg", ".ppm", ".hdr"}) {
    const std::string one = std::string("one") + format, two = std::string("two") + format;
    EXPECT_EQ(run({"white.ray", one, "-w", "40", "-t", "1"}).code, 0);
    EXPECT_EQ(run({"white.ray", two, "-w", "40", "-t", "2", "--time-limit", "1000", "--progress=json"}).code,
              0);
    EXPECT_EQ(bytesOf(one), bytesOf(two)) << format;
  }
}

TEST_F(FilesTest, FramesAreRenderedAgainWhenAnythingReadHasChanged) {
  writeScenes();
  const auto render = [&] {
    return run({"render", "land.ray", "--frames", "0-1", "-w", "8", "-o", "f.####.png"}).last;
  };
  EXPECT_TRUE(contains(render(), "(2 frames"));
  EXPECT_TRUE(contains(render(), "nothing to write"));
  writeGrey("land.png", 0.75);
  EXPECT_TRUE(contains(render(), "(2 frames"));
  write("duck.mtl", "newmtl skin\nKd 1 0 0\nmap_Kd duck.png\n");
  EXPECT_TRUE(contains(render(), "(2 frames"));
  EXPECT_TRUE(contains(render(), "nothing to write"));
}

TEST_F(FilesTest, FramesAreRenderedAgainWhenDamagedOrCut) {
  const auto render = [&] {
    return run({"render", "white.ray", "--frames", "0-2", "-w", "40", "-o", "f.####.png"}).last;
  };
  EXPECT_TRUE(contains(render(), "(3 frames"));
  std::string bytes = bytesOf("f.0001.png");
  const std::string whole = bytes;
  write("f.0001.png", bytes.substr(0, bytes.size() - 20));
  EXPECT_TRUE(contains(render(), "(1 frame, 40x32; 2 already there)"));
  EXPECT_EQ(bytesOf("f.0001.png"), whole);
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
  write("f.0001.png", bytes);
  EXPECT_TRUE(contains(render(), "(1 frame, 40x32; 2 already there)"));
  EXPECT_EQ(bytesOf("f.0001.png"), whole);
}

TEST_F(FilesTest, FramesThatBreakOffSayWhatIsWritten) {
  writeGrey("f.0002.png", 0.5);
  fs::permissions(path("f.0002.png"), fs::perms::owner_read);
  const Run r = run({"render", "white.ray", "--frames", "0-3", "-w", "8", "-o", "f.####.png"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "\"f.0002.png\": it is read-only"));
  EXPECT_TRUE(contains(r.last, "broke off: wrote f.0000.png to f.0001.png (2 of 4 frames, 8x6)")) << r.err;
}

// --- streams ---

TEST_F(FilesTest, ClosedStreamsDoNotStopARender) {
  EXPECT_EQ(run({"white.ray", "expected.png", "-w", "200", "--spp", "16"}).code, 0);
  for (const char* closed : {">&- 2>&-", "<&- >&- 2>&-", "2>&-", "<&-"}) {
    EXPECT_EQ(shell(std::string("ray white.ray out.png -w 200 --spp 16 --progress=json ") + closed), 0)
        << closed;
    EXPECT_EQ(bytesOf("out.png"), bytesOf("expected.png")) << closed;
    fs::remove(path("out.png"));
  }
}

TEST_F(FilesTest, ClosedStdoutIsToldWhereResultsGoThere) {
  EXPECT_EQ(shell("ray features >&- 2>err"), 1);
  EXPECT_TRUE(contains(bytesOf("err"), "standard output"));
}

TEST_F(FilesTest, AClosedPipeOnStderrDoesNotStopARender) {
  // The reader of stderr goes at once; progress is printed four times a second.
  EXPECT_EQ(shell("{ ray white.ray out.png -w 400 --spp 64 -t 1 --progress=json; echo $? >code; } 2>&1 | :"),
            0);
  EXPECT_EQ(bytesOf("code"), "0\n");
  EXPECT_EQ(readPicture(path("out.png")).width, 400);
}

TEST_F(FilesTest, AReaderThatGoesEndsACommandSilently) {
  EXPECT_EQ(shell("{ sleep 0.2; ray features --markdown 2>err; echo $? >code; } | :"), 0);
  EXPECT_EQ(bytesOf("code"), "141\n");
  EXPECT_EQ(bytesOf("err"), "");
}

TEST_F(FilesTest, StatisticsThatNobodyTakesDoNotHideThePicture) {
  EXPECT_EQ(shell("{ sleep 0.2; ray white.ray out.png -w 8 --stats=json 2>err; echo $? >code; } | :"), 0);
  EXPECT_EQ(bytesOf("code"), "0\n");
  EXPECT_TRUE(contains(bytesOf("err"), "wrote out.png"));
  if (!fs::exists("/dev/full")) return;
  EXPECT_EQ(shell("ray white.ray out.png -w 8 --stats=json 2>err >/dev/full"), 1);
  EXPECT_TRUE(contains(bytesOf("err"), "wrote out.png"));
}

TEST_F(FilesTest, AnyNumberOfColumnsWill) {
  for (const char* columns : {"2147483647", "99999999999999999999", "1", "0", "-5", "abc", ""}) {
    const Run r =
        run({"white.ray", "-w", "1000", "--spp", "256", "-t", "1", "--time-limit", "1.3", "--progress=bar"},
            {{"COLUMNS", columns}});
    EXPECT_EQ(r.code, 5) << columns;
    EXPECT_LT(r.err.size(), 100000u) << columns;
    fs::remove(path("white.png"));
  }
}

TEST_F(FilesTest, NamesDoNotCommandTheTerminal) {
  const std::string name = "a\033]0;b\007\033[31m\nwrote \u009bc\x9b";
  const auto expectSafe = [&](const Run& r) {
    for (const std::string& text : {r.out, r.err}) {
      for (const char bad : {'\033', '\007', '\0', '\r'}) EXPECT_EQ(text.find(bad), text.npos) << json(r.err);
      EXPECT_EQ(text.find("\u009b"), text.npos);
      EXPECT_EQ(text.find("\nwrote \\u009b"), text.npos);
    }
  };
  expectSafe(run({name + ".ray"}));               // not there
  expectSafe(run({"white.ray", name + ".txt"}));  // no picture
  expectSafe(run({"white.ray", "-o", name + ".png", "-w", "8"}));
  EXPECT_TRUE(exists(name + ".png"));
  expectSafe(run({"--" + name, "white.ray"}));
  fs::copy_file(path("white.ray"), path(name + ".ray"));
  for (const char* command : {"info", "lint"}) expectSafe(run({command, name + ".ray", "-w", "8"}));
  expectSafe(run({"explain", name + ".ray", "--pixel", "1,1", "-w", "8"}));
  expectSafe(run({"diff", name + ".png", name + ".png"}));
  write("bad.ray", std::string(kWhite) + "mesh { file = \"a\033[31m" + std::string(1, '\0') + "b.ply\"; }");
  const Run r = run({"bad.ray", "-w", "8"});
  expectSafe(r);
  EXPECT_EQ(r.code, 3);
}

TEST_F(FilesTest, WhatIsNoFileNeverKeepsTheProgramWaiting) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo(path("pipe.png").c_str(), 0600), 0);
  const Run silent = run({"pipe", "out.png"});
  EXPECT_EQ(silent.code, 1);
  EXPECT_TRUE(contains(silent.err, "it is a pipe, and no program has opened it to write"));
  const Run limited = run({"pipe", "out.png", "--time-limit", "0.5"});
  EXPECT_EQ(limited.code, 5) << limited.err;
  for (const char* name : {"/dev/zero", "/dev/tty", "/dev/random"})
    EXPECT_TRUE(contains(run({name, "out.png"}).err, "it is a device")) << name;
  for (const char* name : {"/proc/cpuinfo", "/proc/kmsg", "/proc/self/mem", "/proc/self/pagemap"}) {
    if (::access(name, R_OK) != 0) continue;
    EXPECT_TRUE(contains(run({name, "out.png"}).err, "it is no ordinary file")) << name;
    write("names.ray", std::string(kWhite) + "mesh { file = \"" + name + "\"; }\n");
    const Run r = run({"names.ray", "out.png", "-w", "8", "--allow-read", "/"});
    EXPECT_TRUE(contains(r.err, "it is no ordinary file")) << name;
    EXPECT_TRUE(contains(run({"diff", name, name}).err, "it is no ordinary file")) << name;
  }
  // As the picture: nobody reads it.
  const Run written = run({"white.ray", "pipe.png", "-w", "8"});
  EXPECT_TRUE(contains(written.err, "it is a pipe, and no program has opened it to read"));
  EXPECT_FALSE(exists("out.png"));
}

TEST_F(FilesTest, APipeThatSomebodyFillsIsRead) {
  EXPECT_EQ(shell("ray <(sleep 0.3; cat white.ray) out.png -w 8 2> err"), 0) << bytesOf("err");
  EXPECT_EQ(readPicture(path("out.png")).width, 8);
  EXPECT_EQ(shell("mkfifo picture.png; cat picture.png > copy.png & sleep 0.2; ray white.ray picture.png -w "
                  "8 && wait"),
            0);
  EXPECT_EQ(readPicture(path("copy.png")).width, 8);
}

}  // namespace
}  // namespace trace::test
