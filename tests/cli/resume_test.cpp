// Renders that are stopped, by anything, and go on with the next run.
#include <gtest/gtest.h>

#include <random>

#include "program.h"

namespace trace::test {
namespace {

class ResumeTest : public ProgramTest {
 protected:
  static constexpr const char* kScene = R"(SBT-raytracer 1.0
camera { position = (0,0,6); viewdir = (0,0,-1); updir = (0,1,0); }
directional_light { direction = (-1,-1,-2); color = (1,1,1); }
sphere { material = { diffuse = (0.6,0.3,0.2); reflective = (0.4,0.4,0.4); ambient = (0.1,0.1,0.1); } }
)";
  ResumeTest() { write("ball.ray", kScene); }

  std::vector<std::string> words(const std::string& picture, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"ball.ray", picture, "-w", "200", "--spp", "64", "--sampling", "sobol"});
    return more;
  }
  std::string bytes(const std::string& name) const { return readFile(path(name)); }
};

TEST_F(ResumeTest, AfterKillNineThePictureIsTheSameToTheByte) {
  ASSERT_EQ(run(words("whole.png")).code, 0);
  std::mt19937 random(1);
  for (int kills = 0; kills < 400; ++kills) {
    Program program(folder(), words("out.png", {"-t", "2", "--checkpoint-every", "0.02", "--progress=none"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 150));
    program.kill(SIGKILL);
    program.wait();
    if (exists("out.png")) break;
  }
  const Run last = run(words("out.png"));
  EXPECT_EQ(last.code, 0);
  EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
  EXPECT_FALSE(exists("out.png.checkpoint"));
}

TEST_F(ResumeTest, GoesOnByItselfAfterATimeLimit) {
  ASSERT_EQ(run(words("whole.png", {"-w", "300"})).code, 0);
  const Run first = run(words("out.png", {"-w", "300", "-t", "1", "--time-limit", "0.3"}));
  ASSERT_EQ(first.code, 5) << first.err;
  ASSERT_TRUE(exists("out.png.checkpoint")) << first.err;
  const Run second = run(words("out.png", {"-w", "300", "--stats=json"}));
  EXPECT_EQ(second.code, 0);
  EXPECT_TRUE(contains(second.err, "continuing from out.png.checkpoint, ")) << second.err;
  EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
  EXPECT_FALSE(exists("out.png.checkpoint"));
}

TEST_F(ResumeTest, NeverBeginsAnewAndLeavesNothing) {
  run(words("out.png", {"-w", "300", "-t", "1", "--time-limit", "0.3"}));
  const Run r = run(words("out.png", {"-w", "300", "--resume=never"}));
  EXPECT_EQ(r.code, 0);
  EXPECT_FALSE(contains(r.err, "going on")) << r.err;
  EXPECT_FALSE(exists("out.png.checkpoint"));
  run(words("none.png", {"-w", "300", "-t", "1", "--time-limit", "0.3", "--checkpoint-every", "0"}));
  EXPECT_FALSE(exists("none.png.checkpoint"));
}

TEST_F(ResumeTest, SamplesAreAddedToAFinishedPicture) {
  ASSERT_EQ(run(words("whole.png", {"--spp", "100"})).code, 0);
  ASSERT_EQ(run(words("out.png", {"--resume"})).code, 0);
  ASSERT_TRUE(exists("out.png.checkpoint"));
  const Run more = run(words("out.png", {"--spp", "100", "--resume"}));
  EXPECT_TRUE(contains(more.err, "continuing from out.png.checkpoint, 64 % done")) << more.err;
  EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
  const Run grid = run({"ball.ray", "grid.png", "-w", "20", "--resume"});
  EXPECT_TRUE(contains(grid.err, "none can be added later")) << grid.err;
}

TEST_F(ResumeTest, AStartOfManySamplesServesFewer) {
  ASSERT_EQ(run(words("whole.png", {"--spp", "100"})).code, 0);
  const Run first = run(words("out.png", {"--spp", "9999", "-t", "1", "--time-limit", "0.2"}));
  ASSERT_EQ(first.code, 5) << first.err;
  const Run second = run(words("out.png", {"--spp", "100"}));
  EXPECT_EQ(second.code, 0);
  EXPECT_TRUE(contains(second.err, "continuing from out.png.checkpoint, ")) << second.err;
  EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
}

TEST_F(ResumeTest, ASceneSaysHowOftenToWrite) {
  write("never.ray", std::string(kScene) + "settings { checkpoint-every = 0; }\n");
  const std::vector<std::string> all{"never.ray", "out.png", "-w", "300",          "--spp",
                                     "64",        "-t",      "1",  "--time-limit", "0.3"};
  ASSERT_EQ(run(all).code, 5);
  EXPECT_FALSE(exists("out.png.checkpoint"));
  std::vector<std::string> asked = all;
  asked.insert(asked.end(), {"--checkpoint-every", "9"});
  ASSERT_EQ(run(asked).code, 5);
  EXPECT_TRUE(exists("out.png.checkpoint"));
}

TEST_F(ResumeTest, OfAnotherPictureIsTold) {
  run(words("out.png", {"-w", "300", "-t", "1", "--time-limit", "0.3"}));
  const Run r = run(words("out.png", {"-w", "40"}));
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(contains(r.err, "starts from the beginning; out.png.checkpoint: it is of another picture"))
      << r.err;
  EXPECT_TRUE(exists("out.png.checkpoint")) << "who knows whose it is";
  EXPECT_TRUE(contains(r.err, "note: 1 checkpoint of other options or scenes is next to the picture, "))
      << r.err;
  EXPECT_TRUE(contains(r.err, "; to remove it: rm out.png.checkpoint\n")) << r.err;
}

TEST_F(ResumeTest, WhereNoneCanBeWrittenTheRenderGoesOn) {
  const std::string name(245, 'a');  // with ".checkpoint" it is too long for a file
  const Run r = run(words(name + ".png", {"--checkpoint-every", "0.01"}));
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(exists(name + ".png"));
  const std::size_t warning = r.err.find("warning: no checkpoint: ");
  ASSERT_NE(warning, std::string::npos) << r.err;
  EXPECT_EQ(r.err.find("warning:", warning + 1), std::string::npos) << "once is enough";
}

TEST_F(ResumeTest, TwoProcessesOfOnePictureDoNotHarmEachOther) {
  ASSERT_EQ(run(words("whole.png")).code, 0);
  for (int round = 0; round < 3; ++round) {
    const auto all = words("out.png", {"-t", "1", "--checkpoint-every", "0.01", "--progress=none"});
    Program a(folder(), all), b(folder(), all);
    EXPECT_EQ(a.wait(), 0);
    EXPECT_EQ(b.wait(), 0);
    EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
  }
}

TEST_F(ResumeTest, AFrameGoesOnToo) {
  write("turn.ray", std::string(kScene) + "translate(key((0, -1), (1, 1)), 0, 0, sphere { })\n");
  const std::vector<std::string> all{"turn.ray", "f.##.png", "--frames", "0-1", "-w", "300", "--spp", "64"};
  std::vector<std::string> limited = all;
  limited.insert(limited.end(), {"-t", "1", "--time-limit", "0.4"});
  ASSERT_EQ(run(limited).code, 5);
  const Run rest = run(all);
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_TRUE(contains(rest.err, "continuing from f.0")) << rest.err;
  EXPECT_EQ(files(), 5u) << "three scenes and two frames";
}

}  // namespace
}  // namespace trace::test
