// The limits of time and memory reach every command, whatever the input asks for.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <string>

#include "base/error.h"
#include "program.h"
#include "support/panes.h"
#include "support/random.h"

namespace trace::test {
namespace {

constexpr const char* kBegin = R"(SBT-raytracer 1.0
camera { position=(0,0,5); viewdir=(0,0,-1); updir=(0,1,0); aspectratio=1; }
point_light { position=(2,3,5); color=(1,1,1); constant_attenuation_coeff=1; }
)";

/// A thousand maps at four levels: a million times a million copies, one over the other.
std::string manyCopies() {
  std::string maps;
  for (int i = 0; i < 1000; ++i)
    maps += (i > 0 ? ",(" : "(") + ("0.3,0,0," + std::to_string(i * 0.001)) + ", 0,0.3,0," +
            std::to_string(i % 7 * 0.1) + ", 0,0,0.3,0)";
  return "ifs { levels = 4; maps = (" + maps + "); }";
}

/// A cube of 12.6 million triangles.
constexpr const char* kFineMesh = R"(polymesh { subdivide = 10;
  points = ((0,0,0),(1,0,0),(1,1,0),(0,1,0),(0,0,1),(1,0,1),(1,1,1),(0,1,1));
  faces = ((0,3,2),(0,2,1),(4,5,6),(4,6,7),(0,1,5),(0,5,4),(1,2,6),(1,6,5),(2,3,7),(2,7,6),(3,0,4),(3,4,7)); }
)";

class Limits : public ProgramTest {
 protected:
  static constexpr int kLimit = static_cast<int>(Fault::limit);

  Limits() {
    write("copies.ray", kBegin + manyCopies());
    write("sweep.ray", kBegin + std::string("sweep { twist = 15000; }"));
    write("waves.ray", kBegin + std::string("isosurface { formula = \"sin(1000000000*x*y*z)\"; }"));
    write("julia.ray",
          kBegin + std::string("julia { iteration = sine; iterations = 50; mandelbrot = true; }"));
    write("glass.ray", kPanes);
    write("mesh.ray", kBegin + std::string(kFineMesh));
    write("terrain.ray", kBegin + std::string("terrain { points = 4097; octaves = 16; }"));
    write("plant.ray", kBegin + std::string("plant { iterations = 10; }"));
    write("solids.ray", std::string(kBegin) +
                            "difference { objects = { mandelbox { iterations = 30; scale = -1.5; }\n"
                            "union { objects = { isosurface { formula = \"sin(1000000*x*y*z)\"; }\n"
                            "mandelbulb { iterations = 30; } }; }\n"
                            "julia { iteration = sine; iterations = 50; } }; }\n");
  }

  static std::vector<std::string> scenes() {
    return {"copies", "sweep", "waves", "julia", "glass", "mesh", "terrain", "plant", "solids"};
  }

  /// Runs the command for each scene with a limit of a fifth of a second. Where one goes on and on, ctest
  /// ends the test.
  void expectEnds(const std::vector<std::string>& before, const std::vector<std::string>& after) const {
    for (const std::string& scene : scenes()) {
      std::vector<std::string> words = before;
      words.push_back(scene + ".ray");
      words.insert(words.end(), after.begin(), after.end());
      words.insert(words.end(), {"--time-limit", "0.2"});
      const Run r = run(words);
      const bool refused = r.code == 3 && r.err.find("folds finer than") != std::string::npos;  // by convert
      const bool ended =
          r.code == 0 || r.code == kLimit || r.code == 6 || refused;  // 6: lint found something
      EXPECT_TRUE(ended) << scene << ": " << r.code << "\n" << r.err;
      const bool tooManyRays = r.err.find("takes more than 200000 rays") != std::string::npos;  // of explain
      if (r.code == kLimit && !tooManyRays) {
        EXPECT_TRUE(contains(r.err, "time limit")) << scene;
      }
    }
  }
};

TEST_F(Limits, ARenderEndsInTime) { expectEnds({"render"}, {"-r", "60"}); }
TEST_F(Limits, LintEndsInTime) { expectEnds({"lint"}, {"-r", "60"}); }
TEST_F(Limits, BenchEndsInTime) { expectEnds({"bench"}, {"-w", "2000"}); }
TEST_F(Limits, InfoEndsInTime) { expectEnds({"info"}, {}); }
TEST_F(Limits, ExplainEndsInTime) { expectEnds({"explain"}, {"-r", "60", "--pixel", "200,200"}); }
TEST_F(Limits, StereogramEndsInTime) {
  expectEnds({"stereogram"}, {"-o", "dots.png", "-w", "2000", "--height", "2000"});
}
TEST_F(Limits, FramesEndInTime) { expectEnds({"render"}, {"-r", "60", "--frames", "0-2", "-o", "f.##.png"}); }
TEST_F(Limits, ConvertEndsInTime) { expectEnds({"convert"}, {"out.obj"}); }

/// Without a limit, too: what no mesh can follow is refused after some lines of the grid.
TEST_F(Limits, WhatFoldsTooFinelyForAMeshIsRefusedAtOnce) {
  for (const char* out : {"out.obj", "out.ply"}) {
    const Run r = run({"convert", "waves.ray", out});
    EXPECT_EQ(r.code, 3) << out;
    EXPECT_TRUE(contains(r.err, "folds")) << out;
    EXPECT_FALSE(exists(out));
  }
  write("both.ray", kBegin + std::string("isosurface { formula = \"sin(1000000000*x*y*z)\"; }\nsphere { }"));
  const Run both = run({"convert", "both.ray", "out.obj"});
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_TRUE(contains(both.err, "left out, as they cannot become triangles: 1 isosurface"));
  EXPECT_TRUE(contains(both.last, "1 object"));
  EXPECT_EQ(run({"convert", "waves.ray", "out.ray"}).code, 0);  // which holds every shape
}

/// So is how finely a mesh follows what takes long, but for those who ask for more.
TEST_F(Limits, AMeshHasFewerStepsWhereItTakesLongUnlessTheyAreAskedFor) {
  std::string maps = "(0.9,0,0,0, 0,0.9,0,0, 0,0,0.9,0)";  // a cube, and small ones in it
  for (int i = 0; i < 1500; ++i)
    maps += ",(0.001,0,0," + std::to_string(i % 40 * 0.02 - 0.4) + ", 0,0.001,0," +
            std::to_string(i / 40 * 0.02 - 0.4) + ", 0,0,0.001,0)";
  write("cubes.ray", kBegin + ("ifs { levels = 1; maps = (" + maps + "); }"));
  const Run bounded = run({"convert", "cubes.ray", "fewer.obj"});
  EXPECT_EQ(bounded.code, 0) << bounded.err;
  EXPECT_TRUE(contains(bounded.err, "a surface that folds finely becomes triangles in "));
  EXPECT_TRUE(contains(bounded.err, " steps along it, not 64, which would take minutes"));
  EXPECT_TRUE(contains(bounded.err, "--steps 64 makes them all"));
  const Run asked = run({"convert", "cubes.ray", "all.obj", "--steps", "64"});
  EXPECT_EQ(asked.code, 0) << asked.err;
  EXPECT_EQ(asked.err.find("folds finely"), std::string::npos);
  EXPECT_LT(std::filesystem::file_size(path("fewer.obj")), std::filesystem::file_size(path("all.obj")));
  ASSERT_EQ(run({"convert", "white.ray", "coarse.obj", "--steps", "8"}).code, 0);
  ASSERT_EQ(run({"convert", "white.ray", "fine.obj"}).code, 0);
  EXPECT_LT(std::filesystem::file_size(path("coarse.obj")), std::filesystem::file_size(path("fine.obj")));
}

TEST_F(Limits, GradeEndsInTime) {
  std::filesystem::create_directory(path("scenes"));
  std::filesystem::create_directory(path("pictures"));
  ASSERT_EQ(run({"white.ray", "white.png", "-w", "32"}).code, 0);
  for (const std::string& scene : scenes()) {
    std::filesystem::copy(path(scene + ".ray"), path("scenes"));
    std::filesystem::copy(path("white.png"), path("pictures/" + scene + ".png"));
  }
  const Run r = run({"grade", "scenes", "--render", "--reference", "pictures", "-w", "32", "-r", "60",
                     "--time-limit", "0.5"});
  EXPECT_EQ(r.code, kLimit);
  EXPECT_TRUE(contains(r.err, "the time limit of 0.5 s is over while comparing pictures ("));
}

TEST_F(Limits, DiffEndsInTime) {
  ASSERT_EQ(run({"white.ray", "white.png", "-w", "3000"}).code, 0);
  const Run r = run({"diff", "white.png", "white.png", "--ppd", "1000", "--time-limit", "0.2"});
  EXPECT_TRUE(r.code == 0 || r.code == 2) << r.code;  // its own scale: 2 is an error
  if (r.code == 2) {
    EXPECT_TRUE(contains(r.err, "error: the time limit of 0.2 s is over while "));
  }
}

TEST_F(Limits, TheMessageSaysWhatWasDoneAndHowFar) {
  write("bulb.ray", kBegin + std::string("mandelbulb { power = 3; iterations = 30; }"));
  const Run converted = run({"convert", "bulb.ray", "out.obj", "--time-limit", "0.1"});
  EXPECT_EQ(converted.code, kLimit);
  EXPECT_TRUE(contains(converted.err,
                       "error: the time limit of 0.1 s is over while converting the scene, making triangles "
                       "of the objects (0 of 1 done)"));
  EXPECT_TRUE(contains(converted.last, "nothing written: a limit of size, memory or time was reached"));
  EXPECT_FALSE(exists("out.obj"));
  const Run read = run({"info", "mesh.ray", "--time-limit", "0.1"});
  EXPECT_EQ(read.code, kLimit);
  EXPECT_TRUE(contains(read.err, " is over while reading the scene, subdividing a mesh ("));
}

TEST_F(Limits, LongReadingSaysHowFarItIs) {
  const Run r = run({"mesh.ray", "out.png", "--progress=bar", "--time-limit", "3"});
  EXPECT_TRUE(contains(r.err, "\rreading the scene, ")) << r.err;
  const Run quiet = run({"mesh.ray", "out.png", "--progress=none", "--time-limit", "2"});
  EXPECT_FALSE(contains(quiet.err, "\r"));
}

TEST_F(Limits, TheScenesOwnTimeLimitHoldsToo) {
  write("own.ray", kBegin + std::string("settings { time-limit = 0.3; depth = 60; }") +
                       std::string(kPanes).substr(std::string(kPanes).find("material")));
  EXPECT_EQ(run({"lint", "own.ray"}).code, kLimit);
}

TEST_F(Limits, APipeThatNobodyFillsEnds) {
  ASSERT_EQ(::mkfifo(path("pipe.ray").c_str(), 0600), 0);
  const Run r = run({"info", "pipe.ray", "--time-limit", "0.2"});
  EXPECT_EQ(r.code, kLimit);
  EXPECT_TRUE(contains(r.err, "the time limit of 0.2 s is over"));
}

TEST_F(Limits, ADiffThatIsLateEndsWithACodeOfItsOwn) {
  ASSERT_EQ(::mkfifo(path("pipe.png").c_str(), 0600), 0);
  for (const char* name : {"plain", "idiff"}) std::filesystem::create_directory(path(name));
  Program plain(path("plain"), {"diff", "../pipe.png", "../pipe.png", "--time-limit", "0.2"});
  Program idiff(path("idiff"), {"diff", "../pipe.png", "a.png", "--time-limit", "0.2", "--idiff-codes"});
  EXPECT_EQ(plain.wait(), 2);
  EXPECT_EQ(idiff.wait(), 4);
  EXPECT_TRUE(contains(plain.err(), "error: the time limit of 0.2 s is over while reading a picture"));
}

TEST_F(Limits, WhatHasNoEndIsNotReadForEver) {
  const Run device = run({"info", "/dev/zero"});
  EXPECT_EQ(device.code, 1);
  EXPECT_TRUE(contains(device.err, "cannot read \"/dev/zero\": it is a device"));
  ASSERT_EQ(::mkfifo(path("endless").c_str(), 0600), 0);
  for (const char* limit : {"0.05", "0"}) {
    const std::string fill = "cat /dev/zero 2> /dev/null > '" + path("endless") + "' &";
    ASSERT_EQ(std::system(fill.c_str()), 0);
    const Run r = run({"info", "endless", "--time-limit", limit});
    EXPECT_EQ(r.code, kLimit) << r.err;
  }
}

TEST_F(Limits, MemoryEndsEveryCommand) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer's memory would count";
  const std::vector<std::vector<std::string>> commands{{"render", "mesh.ray", "out.png"},
                                                       {"lint", "mesh.ray"},
                                                       {"info", "mesh.ray"},
                                                       {"bench", "mesh.ray"},
                                                       {"explain", "mesh.ray", "--pixel", "0,0"},
                                                       {"convert", "mesh.ray", "out.obj"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--max-memory", "120"});
    const Run r = run(words);
    EXPECT_EQ(r.code, kLimit) << words[0] << r.err;
    EXPECT_TRUE(contains(r.err, "error: out of memory while reading the scene, subdividing a mesh ("))
        << words[0];
    EXPECT_TRUE(contains(r.err, "hint: --max-memory N allows N MiB")) << words[0];
  }
}

TEST_F(Limits, LackOfMemoryNamesWhatIsConverted) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer's memory would count";
  std::string spheres = kBegin;
  for (int i = 0; i < 5000; ++i) spheres += "sphere { }\n";
  write("spheres.ray", spheres);
  const Run r = run({"convert", "spheres.ray", "out.obj", "--max-memory", "100"});
  EXPECT_EQ(r.code, kLimit) << r.err;
  EXPECT_TRUE(
      r.err.starts_with("spheres.ray: error: out of memory while converting the scene, making triangles "
                        "of the objects ("))
      << r.err;
  EXPECT_TRUE(contains(r.err, " of 5000 done)\n  hint: --max-memory N allows N MiB"));
  EXPECT_FALSE(exists("out.obj"));
}

/// Slabs with gaps between them, 500 x 500 x 500 along a ray: each is a crossing of its own.
std::string manySlabs() {
  std::string maps;
  for (int i = 0; i < 500; ++i)
    maps += (i > 0 ? ",(" : "(") + std::string("0.9,0,0,0, 0,0.9,0,0, 0,0,0.0004,") +
            std::to_string(i / 500.0 - 0.5) + ")";
  return "ifs { levels = 3; maps = (" + maps + "); }";
}

TEST_F(Limits, MemoryEndsARender) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer's memory would count";
  write("slabs.ray", kBegin + manySlabs());
  const Run r = run({"slabs.ray", "out.png", "-w", "40", "--max-memory", "50", "--time-limit", "200"});
  EXPECT_EQ(r.code, kLimit);
  EXPECT_TRUE(contains(r.last, "stopped for lack of memory: "));
}

TEST_F(Limits, MemoryEndsADiff) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer's memory would count";
  constexpr std::size_t kSide = 4000;
  const std::string header = "P6\n4000 4000\n255\n";
  write("large.ppm", header);
  std::filesystem::resize_file(path("large.ppm"), header.size() + 3 * kSide * kSide);
  std::filesystem::copy(path("large.ppm"), path("other.ppm"));
  const Run r = run({"diff", "large.ppm", "other.ppm", "--max-memory", "100"});
  EXPECT_EQ(r.code, 2);  // its own scale
  EXPECT_TRUE(contains(r.err, "memory"));
  EXPECT_EQ(r.err.find("bad_alloc"), std::string::npos) << r.err;
}

/// However little there is, from too little to load the program to enough.
TEST_F(Limits, LastingLackOfMemoryEndsWithAMessage) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer's memory would count";
  write("large.ray", kBegin + std::string("sphere {}"));
  int messages = 0;
  for (rlim_t mebibytes = 40; mebibytes <= 160; mebibytes += 8) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
    rlimit less = before;
    less.rlim_cur = mebibytes << 20;
    ASSERT_EQ(::setrlimit(RLIMIT_AS, &less), 0);  // what the program begins with
    Program program(folder(), {"large.ray", "out.png", "-w", "1500", "-t", "2"});
    ::setrlimit(RLIMIT_AS, &before);
    const int code = program.wait();
    EXPECT_GE(code, 0) << mebibytes << " MiB: a signal ended it\n" << program.err();
    if (code == kLimit || code == 1) {
      ++messages;
      EXPECT_TRUE(contains(program.err(), "error: ")) << mebibytes << " MiB";
      EXPECT_EQ(program.err().find("bad_alloc"), std::string::npos) << program.err();
    }
  }
  EXPECT_GT(messages, 0);
}

TEST_F(Limits, CountsThatAreKnownAreChecked) {
  std::string points;
  for (int i = 0; i < 5000; ++i) points += std::to_string(i) + " 0 " + std::to_string(i * i % 97) + " ";
  std::string section;
  for (int i = 0; i < 5000; ++i) section += std::to_string(i) + " " + std::to_string(i % 3) + " ";
  write("extrusion.wrl", "#VRML V2.0 utf8\nShape { geometry Extrusion { spine [" + points +
                             "] crossSection [" + section + "] } }\n");
  const Run extrusion = run({"info", "extrusion.wrl"});
  EXPECT_EQ(extrusion.code, kLimit);
  EXPECT_TRUE(contains(extrusion.err, "an Extrusion of 5000 times 5000 points"));
  std::string shown;
  for (int i = 0; i < 100; ++i) shown += "sphere {} ";
  write("sparks.ray",
        kBegin + ("particles { rate = 40000; lifetime = 2; lifetime_spread = 0; " + shown + "}"));
  const Run sparks = run({"info", "sparks.ray", "--time", "2"});
  EXPECT_EQ(sparks.code, kLimit);
  EXPECT_TRUE(contains(sparks.err, "of 100 objects are more than"));
}

}  // namespace
}  // namespace trace::test
