// Renders that take long: progress, and all the ways to end them early without losing what is done.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/sanitized.h"
#include "image/codecs/codec.h"
#include "program.h"
#include "support/panes.h"

namespace trace::test {
namespace {

using nlohmann::json;

class Stop : public ProgramTest {
 protected:
  /// Minutes of work in many tiles of some milliseconds.
  static std::vector<std::string> longRender(std::vector<std::string> more = {}) {
    more.insert(more.begin(),
                {"white.ray", "out.png", "-w", "1000", "--spp", "256", "-t", "2", "--progress=json"});
    return more;
  }

  /// Years of work in one tile.
  std::vector<std::string> endlessTile() const {
    write("panes.ray", kPanes);
    return {"panes.ray", "out.png", "-w", "8", "-r", "60", "--progress=json"};
  }

  /// Pixels that have samples are white, as the first one is, the others black; the file says that it is a
  /// part.
  void expectPart() const {
    const Picture picture = readPicture(path("out.png"));
    EXPECT_EQ(picture.at(0, 0), Color(1));
    for (const Color& color : picture.pixels) ASSERT_TRUE(color == Color(1) || color == Color(0));
    bool saysSo = false;
    for (const auto& [key, text] : readMetadata(path("out.png"))) saysSo |= key == "Incomplete";
    EXPECT_TRUE(saysSo);
  }

  /// Waits until some tiles are done; false after a minute.
  static bool hasBegun(const Program& program) {
    for (int i = 0; i < 6000; ++i) {
      const std::string text = program.err();
      const size_t end = text.rfind('\n');
      const size_t start = end == std::string::npos || end == 0 ? 0 : text.rfind('\n', end - 1) + 1;
      const json line = json::parse(text.substr(start, end - start), nullptr, false);
      if (line.is_object() && line["done"] > 10) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
};

TEST_F(Stop, CtrlCKeepsThePart) {
  for (int signal : {SIGINT, SIGTERM}) {
    Program program(folder(), longRender({"--stats=json"}));
    ASSERT_TRUE(hasBegun(program)) << program.err();
    program.kill(signal);
    EXPECT_EQ(program.wait(), 4);
    EXPECT_TRUE(contains(program.lastLine(), "stopped by the user: wrote out.png (1000x800, "));
    EXPECT_TRUE(contains(program.lastLine(), " % done) in "));
    EXPECT_EQ(json::parse(program.out())["end"], "cancelled");
    expectPart();
    std::filesystem::remove(path("out.png"));
    EXPECT_TRUE(std::filesystem::remove(path("out.png.checkpoint")));
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(Stop, CtrlCDoesNotWaitForATileThatTakesTooLong) {
  Program program(folder(), endlessTile());
  ASSERT_TRUE(program.says("\"done\":"));
  program.kill(SIGINT);
  EXPECT_EQ(program.wait(), 4);
  EXPECT_TRUE(contains(program.lastLine(), "stopped by the user: nothing written"));
}

TEST_F(Stop, CtrlCTwiceEndsAtOnce) {
  Program program(folder(), endlessTile());
  ASSERT_TRUE(program.says("\"done\":"));
  program.kill(SIGINT);
  ASSERT_TRUE(program.says("Ctrl-C again"));
  program.killAgain(SIGINT);
  EXPECT_EQ(program.wait(), 130);
  // Under the sanitizers a line of progress may follow, in the time that the process takes to end.
  EXPECT_TRUE(contains(kSanitized ? program.err() : program.lastLine(), "nothing written"));
  EXPECT_FALSE(exists("out.png"));
}

TEST_F(Stop, TwoSignalsAtOnceAreOneWishToStop) {
  Program program(folder(), longRender());
  ASSERT_TRUE(hasBegun(program)) << program.err();
  program.kill(SIGINT);  // as `timeout` sends one to the program and one to its group
  program.kill(SIGTERM);
  EXPECT_EQ(program.wait(), 4) << program.err();
  EXPECT_TRUE(contains(program.lastLine(), "stopped by the user: wrote out.png")) << program.err();
}

/// A bar that is drawn is wiped out behind it.
constexpr const char* kNothing = "stopped by the user: nothing written, for nothing was finished\n";

TEST_F(Stop, CtrlCWhilePhotonsFlyEndsWithALastLine) {
  write("photons.ray", std::string(kWhite) + "sphere { material = { reflective = (1,1,1); } }\n");
  for (int signal : {SIGINT, SIGTERM}) {
    Program program(folder(), {"photons.ray", "out.png", "-w", "8", "--caustics", "50000000", "-t", "2",
                               "--progress=bar"});
    ASSERT_TRUE(program.says("sending photons")) << program.err();
    program.kill(signal);
    EXPECT_EQ(program.wait(), 4);
    EXPECT_TRUE(contains(program.err(), kNothing));
    EXPECT_FALSE(exists("out.png"));
  }
}

TEST_F(Stop, CtrlCWhileMomentsAreBuiltEndsWithALastLine) {
  write("rise.ray", std::string(kWhite) + "terrain { points = 513; height = key((0, 0.1), (1, 0.9)); }\n");
  Program program(
      folder(), {"rise.ray", "out.png", "-w", "8", "--shutter", "1", "--moments", "4096", "--progress=bar"});
  ASSERT_TRUE(program.says("building the moments")) << program.err();
  program.kill(SIGINT);
  EXPECT_EQ(program.wait(), 4);
  EXPECT_TRUE(contains(program.err(), kNothing));
}

TEST_F(Stop, SnapshotOnRequest) {
  for (int signal : {SIGUSR1, SIGHUP}) {
    Program program(folder(), longRender());
    ASSERT_TRUE(hasBegun(program));
    program.kill(signal);
    ASSERT_TRUE(program.says("going on")) << program.err();
    expectPart();
    std::filesystem::remove(path("out.png"));
    program.kill(SIGINT);
    EXPECT_EQ(program.wait(), 4);
    EXPECT_TRUE(exists("out.png"));
  }
}

TEST_F(Stop, TimeLimitKeepsThePart) {
  Program program(folder(), longRender({"--time-limit", "2", "--stats=json"}));
  EXPECT_EQ(program.wait(), 5);
  EXPECT_EQ(program.lastLine().substr(0, 46), "stopped by the time limit: wrote out.png (1000")
      << program.err();
  EXPECT_EQ(json::parse(program.out())["end"], "timeLimit");
  expectPart();
}

TEST_F(Stop, APartOfSeveralSamplesIsTheWholePictureAndSaysHowMany) {
  Program program(folder(), {"white.ray", "out.png", "-w", "40", "--spp", "65536", "--time-limit", "2"});
  EXPECT_EQ(program.wait(), 5);
  EXPECT_TRUE(contains(program.lastLine(), "wrote out.png (40x32, about ")) << program.err();
  EXPECT_TRUE(contains(program.lastLine(), " of 65536 samples a pixel, ")) << program.err();
  for (const Color& color : readPicture(path("out.png")).pixels) EXPECT_EQ(color, Color(1));
}

TEST_F(Stop, PictureIsSavedElsewhereIfItsPlaceIsGone) {
  std::filesystem::create_directory(path("there"));
  std::filesystem::create_directory(path("temporary"));
  Program program(folder(),
                  {"white.ray", "there/out.png", "-w", "1000", "--spp", "256", "-t", "2", "--progress=json"},
                  {{"TMPDIR", path("temporary")}});
  ASSERT_TRUE(hasBegun(program));
  std::filesystem::remove_all(path("there"));
  program.kill(SIGINT);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_TRUE(contains(program.lastLine(), "wrote " + path("temporary") + "/trace-"));
  EXPECT_TRUE(contains(program.lastLine(), "/out.png (1000x800, "));
  EXPECT_TRUE(contains(program.lastLine(), "instead of there/out.png"));
  const auto folder = std::filesystem::directory_iterator(path("temporary"))->path();  // nobody else's
  EXPECT_EQ(readPicture((folder / "out.png").string()).width, 1000);
}

TEST_F(Stop, TheLastLineSaysWhichFilesAreInTheirPlaceAllTheSame) {
  std::filesystem::create_directory(path("temporary"));
  write("out.png", "old");
  std::vector<std::string> words = longRender({"--passes", "depth,id"});
  words[5] = "1";  // --spp 1: it finishes
  words[3] = "1400";
  Program program(folder(), words, {{"TMPDIR", path("temporary")}});
  ASSERT_TRUE(hasBegun(program)) << program.err();
  std::filesystem::create_directories(path("out.depth.exr/full"));
  EXPECT_EQ(program.wait(), 1) << program.err();
  EXPECT_TRUE(contains(program.lastLine(), "wrote " + path("temporary") + "/trace-"));
  EXPECT_FALSE(contains(program.lastLine(), "instead of out.png")) << "it was replaced";
  EXPECT_TRUE(contains(program.lastLine(),
                       "because not all files could be written in their place; there is out.png"));
  EXPECT_EQ(readPicture(path("out.png")).width, 1400);
  const auto there = std::filesystem::directory_iterator(path("temporary"))->path();
  for (const char* name : {"out.png", "out.depth.exr", "out.id.exr"})
    EXPECT_EQ(readPicture((there / name).string()).width, 1400) << name;
}

/// A limit of the size of files takes the place of a full disk: what is small is written, a pass is not,
/// nowhere.
TEST_F(Stop, WhereNothingTakesAllFilesTheLastLineSaysWhichAreThere) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit less = before;
  less.rlim_cur = 20000;
  ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &less), 0);
  const Run r = run({"white.ray", "out.png", "-w", "200", "--passes", "depth,normal", "--resume=never"});
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(r.code, 1) << r.err;
  EXPECT_TRUE(contains(r.last, "not all files could be written; there "));
  EXPECT_TRUE(contains(r.last, "out.png"));
  EXPECT_EQ(r.last.find("nothing written"), r.last.npos) << r.last;
  EXPECT_TRUE(exists("out.png"));
}

/// A picture that is traced in a moment; to take its noise out takes long.
constexpr const char* kDenoised[] = {"white.ray", "out.png", "-w", "700",      "--spp", "8",
                                     "--denoise", "-t",      "1",  "--passes", "depth", "--progress=bar"};

TEST_F(Stop, CtrlCAfterTheLastRayKeepsWhatWasTraced) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program(folder(), {std::begin(kDenoised), std::end(kDenoised)});
    ASSERT_TRUE(program.says("taking noise out")) << program.err();
    program.kill(signal);
    EXPECT_EQ(program.wait(), 4) << program.err();
    EXPECT_TRUE(contains(program.err(),
                         "stopped while taking noise out: the picture is written without "
                         "--denoise and its passes; its samples are kept"));
    EXPECT_TRUE(contains(program.lastLine(), "stopped by the user: wrote out.png (700x560) in "));
    EXPECT_TRUE(contains(program.lastLine(), "the same command continues from there"));
    EXPECT_EQ(readPicture(path("out.png")).at(350, 280), Color(1));
    EXPECT_FALSE(exists("out.depth.exr"));
    std::filesystem::remove(path("out.png"));
    ASSERT_TRUE(exists("out.png.checkpoint"));
    if (signal == SIGINT) std::filesystem::remove(path("out.png.checkpoint"));
  }
  // The same command finishes it, without a ray, and takes the checkpoint away; here with less to do.
  const Run r = run({"white.ray", "out.png", "-w", "700", "--spp", "8", "--denoise", "-t", "1", "--passes",
                     "depth", "--time-limit", "1"});
  EXPECT_TRUE(contains(r.err, "continuing from out.png.checkpoint, 100 % done"));
  EXPECT_TRUE(exists("out.png"));
}

TEST_F(Stop, TheTimeLimitHoldsAfterTheLastRayToo) {
  std::vector<std::string> words{std::begin(kDenoised), std::end(kDenoised)};
  words[3] = "2000";
  words.insert(words.end(), {"--time-limit", "1"});
  const Run r = run(words);
  EXPECT_EQ(r.code, 5) << r.err;
  if (!exists("out.png")) GTEST_SKIP() << "the machine is too busy to trace a tile within the limit";
  EXPECT_TRUE(contains(r.last, "stopped by the time limit: wrote out.png")) << r.err;
  EXPECT_TRUE(exists("out.png.checkpoint"));
}

TEST_F(Stop, ASnapshotDoesNotKeepAStopWaiting) {
  std::vector<std::string> words{std::begin(kDenoised), std::end(kDenoised)};
  words[5] = "4096";
  Program program(folder(), words);
  ASSERT_TRUE(program.says("elapsed")) << program.err();
  program.kill(SIGUSR1);  // takes its noise out, if there are samples enough
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  program.kill(SIGINT);
  ASSERT_TRUE(program.says("Ctrl-C again")) << program.err();
  EXPECT_EQ(program.wait(), 4);
}

TEST_F(Stop, AFragmentGoesBesideAWholePicture) {
  for (const char* suffix : {"png", "bmp"}) {
    const std::string name = std::string("out.") + suffix, part = std::string("out.partial.") + suffix;
    EXPECT_EQ(run({"white.ray", name, "-w", "40"}).code, 0);
    const std::string whole = readFile(path(name));
    std::vector<std::string> words = longRender();
    words[1] = name;
    Program program(folder(), words);
    ASSERT_TRUE(hasBegun(program)) << program.err();
    program.kill(SIGUSR1);
    ASSERT_TRUE(program.says("going on")) << program.err();
    EXPECT_TRUE(contains(program.err(), "wrote " + part + " (1000x800, "));
    program.kill(SIGINT);
    EXPECT_EQ(program.wait(), 4);
    EXPECT_TRUE(contains(program.lastLine(), "stopped by the user: wrote " + part + " (1000x800, "));
    EXPECT_TRUE(contains(program.lastLine(), "; " + name + " is kept as it is"));
    EXPECT_EQ(readFile(path(name)), whole);
    EXPECT_EQ(readPicture(path(part)).width, 1000);

    words.insert(words.end(), {"--time-limit", "0.7"});
    const Run limited = run(words);
    EXPECT_EQ(limited.code, 5);
    EXPECT_TRUE(contains(limited.last, "stopped by the time limit: wrote " + part));
    EXPECT_EQ(readFile(path(name)), whole);
  }
  EXPECT_EQ(files(), 7u) << "a scene, and of each a picture, a fragment and a checkpoint";
}

TEST_F(Stop, TheWholePictureTakesItsFragmentAway) {
  ASSERT_EQ(run({"white.ray", "out.png", "-w", "40"}).code, 0);
  Metadata words = readMetadata(path("out.png"));
  words.emplace_back("Incomplete", "the render was stopped");
  writePicture(path("out.partial.png"), readPicture(path("out.png")), Rounding::truncate, words);
  EXPECT_TRUE(run({"white.ray", "out.png", "-w", "41"}).last.ends_with(" s")) << "another picture";
  EXPECT_TRUE(exists("out.partial.png"));
  const Run r = run({"white.ray", "out.png", "-w", "40"});
  EXPECT_TRUE(r.last.ends_with(" s; removed out.partial.png")) << r.last;
  EXPECT_FALSE(exists("out.partial.png"));
}

TEST_F(Stop, NothingIsLeftOfWhatWasBeingWritten) {
  for (int round = 0; round < 5; ++round) {
    std::vector<std::string> words = longRender();
    words[1] = "out.exr";
    Program program(folder(), words);
    ASSERT_TRUE(hasBegun(program)) << program.err();
    program.kill(SIGUSR1);  // takes a while
    program.kill(SIGINT);
    ASSERT_TRUE(program.says("Ctrl-C again")) << program.err();
    std::this_thread::sleep_for(std::chrono::milliseconds(20 * round));
    program.kill(SIGTERM);
    program.wait();
    // A process that dies between naming a file and putting it in its place leaves it to the next that writes
    // there.
    Program(folder(), {"white.ray", "next.png", "-w", "8"}).wait();
    // What was traced stays beside the picture where the picture could not be finished.
    const std::set<std::string> known{"white.ray", ".stdout",  ".stderr",
                                      "out.exr",   "next.png", "out.exr.checkpoint"};
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(known.contains(name)) << name;
      if (name == "out.exr") {
        EXPECT_EQ(readPicture(path(name)).width, 1000);
      }
    }
  }
}

TEST_F(Stop, JsonProgress) {
  constexpr int kLines = 4;
  Program program(folder(), longRender({}));
  EXPECT_TRUE(program.says("\"elapsed\"", kLines));
  program.kill(SIGINT);
  program.wait();
  std::istringstream lines(program.err());
  int count = 0;
  double last = -1;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] != '{') continue;
    const json object = json::parse(line);
    EXPECT_EQ(object.size(), 5u);
    EXPECT_GE(object["elapsed"], last);
    EXPECT_LE(object["done"], object["total"]);
    EXPECT_TRUE(object["remaining"].is_null() || object["remaining"] >= 0);
    last = object["elapsed"];
    ++count;
  }
  EXPECT_GE(count, kLines);
}

TEST_F(Stop, PlainProgressInALog) {
  Program program(folder(), longRender({"--progress=auto"}));
  EXPECT_TRUE(program.says(" % done, ")) << program.err();
  program.kill(SIGINT);
  program.wait();
  EXPECT_FALSE(contains(program.err(), "\r"));
  EXPECT_TRUE(contains(program.err(), " elapsed"));
  Program brief(folder(), {"white.ray", "-w", "64"});
  brief.wait();
  EXPECT_FALSE(contains(brief.err(), " elapsed"));
  EXPECT_TRUE(contains("\n" + brief.err(), "\nwrote "));
}

TEST_F(Stop, HowLongPhotonsOfMomentsWillFlyIsTold) {
  write("moves.ray", R"(SBT-raytracer 1.0
settings { integrator = photon; fog = 0.05; fog-color = (1, 1, 1); shutter = 0.5; moments = 64; photons = 5000; }
camera { position = (0, 1, 6); look_at = (0, 1, 0); fov = 50; }
point_light { position = (0, 3, 3); color = (1, 1, 1); }
scale(6, 0.1, 6, box { material = { diffuse = (1, 1, 1); }; })
translate(key((0, 0), (1, 1)), 1, 0, sphere { material = { diffuse = (1, 1, 1); }; })
)");
  Program program(folder(), {"moves.ray", "-o", "moves.png", "-w", "20", "-t", "1", "--progress=bar"});
  EXPECT_TRUE(program.says(" of this left")) << program.err();
  program.kill(SIGINT);
  program.wait();
}

TEST_F(Stop, BarIfAskedFor) {
  Program program(folder(), longRender({"--progress=bar"}), {{"COLUMNS", "60"}});
  EXPECT_TRUE(program.says("elapsed")) << program.err();
  program.kill(SIGINT);
  program.wait();
  EXPECT_TRUE(contains(program.err(), "\r"));
  EXPECT_TRUE(contains(program.err(), "elapsed"));
  std::string text = program.err();
  size_t longest = 0;
  for (size_t at = 0; (at = text.find('\r', at)) != std::string::npos; ++at) {
    const size_t end = text.find_first_of("\033\n", at);
    if (end != std::string::npos && text[end] == '\033')
      longest = std::max(longest, end - at - 1);  // else it is a message
  }
  EXPECT_EQ(longest, 59u);
}

TEST_F(Stop, NoProgressIfNotWanted) {
  for (const char* flag : {"--progress=none", "--log-level=error"}) {
    Program program(folder(),
                    {"white.ray", "-w", "1000", "--spp", "256", "-t", "2", "--time-limit", "1.5", flag});
    program.wait();
    EXPECT_EQ(program.err().substr(0, 7), "stopped") << program.err();
  }
}

// --- grade ---------------------------------------------------------------------------------------------

class StopGrade : public Stop {
 protected:
  void SetUp() override {
    Stop::SetUp();
    std::filesystem::create_directories(path("scenes"));
    std::filesystem::create_directories(path("ref"));
    write("scenes/a.ray", kWhite);
    write("scenes/b.ray", kPanes);
    write("scenes/c.ray", kWhite);
    for (const char* name : {"a", "b", "c"})
      writePicture(path("ref/" + std::string(name) + ".png"), Picture(8, 8));
  }
  static std::vector<std::string> words(std::vector<std::string> more) {
    std::vector<std::string> all{"grade", "scenes", "--reference", "ref", "--render", "-w",
                                 "8",     "-r",     "60",          "-o",  "page.html"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::string page() const { return readFile(path("page.html")); }

  static constexpr const char* kWhite = "SBT-raytracer 1.0\nsphere { material = { emissive = (1, 1, 1); } }";
};

TEST_F(StopGrade, TimeLimitKeepsWhatWasCompared) {
  const Run r = run(words({"--time-limit", "1"}));
  EXPECT_EQ(r.code, 5) << r.err;
  EXPECT_NE(r.out.find("not reached  b.png"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("beyond       a.png"), std::string::npos) << r.out;
  EXPECT_NE(r.err.find("2 of 3 pairs not reached: the time limit of 1 s is over"), std::string::npos)
      << r.err;
  EXPECT_NE(page().find("not reached"), std::string::npos);
}

TEST_F(StopGrade, SceneLimitGoesOnWithTheNext) {
  const Run r = run(words({"--scene-limit", "1"}));
  EXPECT_EQ(r.code, 6) << r.err;
  EXPECT_NE(r.out.find("b.png: it takes longer than the 1 s of --scene-limit"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("beyond      c.png"), std::string::npos) << r.out;
}

TEST_F(StopGrade, CtrlCKeepsWhatWasCompared) {
  Program program(folder(), words({}));
  std::this_thread::sleep_for(std::chrono::seconds(2));  // it is in the second scene for ever
  program.kill(SIGINT);
  EXPECT_EQ(program.wait(), 4) << program.err();
  EXPECT_NE(program.err().find("2 of 3 pairs not reached: stopped by the user"), std::string::npos)
      << program.err();
  EXPECT_NE(page().find("not reached"), std::string::npos);
}

}  // namespace
}  // namespace trace::test
