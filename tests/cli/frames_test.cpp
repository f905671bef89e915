// Animations: ray render SCENE --frames A-B.
#include "cli/frames.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "image/codecs/codec.h"
#include "program.h"
#include "support/panes.h"

namespace trace::test {
namespace {

using cli::frameName;

TEST(FrameName, PutsTheNumberInThePlaceOfTheLastHashes) {
  EXPECT_EQ(frameName("a.####.png", 7), "a.0007.png");
  EXPECT_EQ(frameName("a#.png", 12345), "a12345.png");
  EXPECT_EQ(frameName("#1/b-##.png", 3), "#1/b-03.png");
  EXPECT_EQ(frameName("##", 3), "03");
  EXPECT_EQ(frameName("a.png", 3), "a.png");
}

class Frames : public ProgramTest {
 protected:
  /// Inside of a ball that glows the brighter the later: white at 2 seconds.
  static constexpr const char* kGlow = R"(SBT-raytracer 1.0
camera { aspectratio = 2; }
scale(10, sphere { material = { emissive = key((0, 0), (2, 1)); } })
)";
  Frames() { write("glow.ray", kGlow); }

  Run render(std::vector<std::string> more = {}, const std::string& frames = "0-4") const {
    std::vector<std::string> words{"render", "glow.ray", "-w", "8", "--fps", "2", "--frames", frames};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  double brightness(const std::string& name) const { return readPicture(path(name)).at(0, 0).r; }
  auto written(const std::string& name) const { return std::filesystem::last_write_time(path(name)); }
};

TEST_F(Frames, ShowTheSceneAtTheirTimes) {
  const Run r = render();
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.last, "wrote glow.0000.png to glow.0004.png (5 frames, 8x4) in ")) << r.err;
  for (int frame = 0; frame <= 4; ++frame)
    EXPECT_NEAR(brightness("glow.000" + std::to_string(frame) + ".png"), frame / 4.0, 1.0 / 255) << frame;
  EXPECT_EQ(run({"glow.ray", "-w", "8", "--time", "1.5", "-o", "moment.bmp"}).code, 0);
  EXPECT_NEAR(brightness("moment.bmp"), 0.75, 1.0 / 255);
}

TEST_F(Frames, HaveOneExposureInWhateverRun) {
  write("glow.ray", "Trace 1\nsphere { material = { emissive = key((0, (1, 1, 1)), (2, (9, 9, 9))) } }\n");
  const std::vector<std::string> quick{"--quality", "draft", "--spp",  "1",
                                       "--denoise", "off",   "--tone", "clamp"};
  EXPECT_EQ(render(quick, "0-2").code, 0);
  const Picture in = readPicture(path("glow.0002.png"));
  std::filesystem::remove(path("glow.0002.png"));
  EXPECT_EQ(render(quick, "2").code, 0);
  EXPECT_EQ(readPicture(path("glow.0002.png")), in);
}

TEST_F(Frames, ASceneMayChooseItsMoment) {
  write("later.ray", std::string(kGlow) + "settings { time = 1; }");
  run({"later.ray", "-w", "8", "-o", "a.bmp"});
  EXPECT_NEAR(brightness("a.bmp"), 0.5, 1.0 / 255);
  run({"later.ray", "-w", "8", "-o", "a.bmp", "--time", "2"});
  EXPECT_EQ(brightness("a.bmp"), 1);
}

TEST_F(Frames, AreSkippedWhenTheyAreThereWithTheSameSettings) {
  render();
  const auto before = written("glow.0003.png");
  Run r = render({"-t", "1"});  // threads do not change a picture
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(contains(r.last, "nothing to write")) << r.err;
  EXPECT_EQ(written("glow.0003.png"), before);
  std::filesystem::remove(path("glow.0002.png"));
  write("glow.0004.png", "no picture");
  r = render();
  EXPECT_TRUE(contains(r.last, "(2 frames, 8x4; 3 already there)")) << r.err;
  EXPECT_EQ(written("glow.0003.png"), before);
  EXPECT_EQ(brightness("glow.0004.png"), 1);
}

TEST_F(Frames, AreRenderedAgainWhenSettingsSceneOrSizeDiffer) {
  render();
  EXPECT_TRUE(contains(render({"--depth", "2"}).last, "(5 frames, 8x4)"));
  EXPECT_TRUE(contains(render({"--depth", "2", "--passes", "id"}).last, "(5 frames, 8x4 and the pass id)"));
  EXPECT_TRUE(contains(render({"--depth", "2", "--passes", "id"}).last, "nothing to write"));
  std::filesystem::remove(path("glow.0001.id.exr"));
  EXPECT_TRUE(
      contains(render({"--depth", "2", "--passes", "id"}).last, "(1 frame, 8x4 and the pass id; 4 already"));
  write("glow.ray", std::string(kGlow) + " // edited");
  EXPECT_TRUE(contains(render({"--depth", "2", "--passes", "id"}).last, "(5 frames"));
}

TEST_F(Frames, EveryNthAndSingleOnes) {
  EXPECT_EQ(render({}, "0-4/2").code, 0);
  EXPECT_TRUE(exists("glow.0002.png") && !exists("glow.0001.png"));
  EXPECT_EQ(render({"-o", "one.png"}, "3").code, 0);
  EXPECT_TRUE(exists("one.png"));
}

TEST_F(Frames, ThoseOfAnotherBuildAreRenderedAgain) {
  EXPECT_EQ(render().code, 0);
  EXPECT_TRUE(contains(render().last, "nothing to write"));
  // The same picture with the same words, but for those that another program would have put there.
  const Picture picture = readPicture(path("glow.0002.png"));
  Metadata words = readMetadata(path("glow.0002.png"));
  const auto program =
      std::find_if(words.begin(), words.end(), [](const auto& word) { return word.first == "Program"; });
  ASSERT_NE(program, words.end());
  EXPECT_TRUE(contains(program->second, "sources "));
  program->second = "commit 0000000, sources 0123456789abcdef";
  writePicture(path("glow.0002.png"), picture, Rounding::truncate, words);
  EXPECT_TRUE(contains(render().last, "(1 frame, 8x4; 4 already there)"));
  words.erase(program);  // a program that did not say it
  writePicture(path("glow.0003.png"), picture, Rounding::truncate, words);
  EXPECT_TRUE(contains(render().last, "(1 frame, 8x4; 4 already there)"));
  EXPECT_TRUE(contains(render().last, "nothing to write"));
}

TEST_F(Frames, ThoseOfOtherOptionsAreRenderedAgain) {
  const std::vector<std::vector<std::string>> options{
      {"--spp", "4"},      {"--depth", "3"},     {"--integrator", "path"}, {"--sampling", "sobol"},
      {"--seed", "7"},     {"--shutter", "0.1"}, {"--like", "ut"},         {"--tone", "reinhard"},
      {"--exposure", "1"}, {"--bloom", "0.2"},   {"--region", "0,0,4,4"},  {"-w", "10"}};
  EXPECT_EQ(render().code, 0);
  for (const auto& option : options) {
    const Run r = render(option);
    if (r.code == 2) continue;  // no such option
    EXPECT_TRUE(contains(r.last, "(5 frames")) << option[0] << r.err;
    EXPECT_TRUE(contains(render(option).last, "nothing to write")) << option[0];
    EXPECT_TRUE(contains(render().last, "(5 frames")) << option[0];
  }
  EXPECT_TRUE(contains(render({"-t", "1"}).last, "nothing to write"));  // which changes no pixel
}

TEST_F(Frames, WrongOnesAreRefused) {
  for (const char* wrong : {"", "a", "4-2", "-3", "1.5", "1-2-3", "0-9/0", "0-9/", "1-2000000"})
    EXPECT_EQ(render({}, wrong).code, 2) << wrong;
  const Run r = render({"-o", "one.png"});
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(contains(r.err, "####"));
  EXPECT_EQ(render({"--fps", "0"}).code, 2);
}

TEST_F(Frames, TheTimeLimitIsOfAllOfThem) {
  const Run r = render({"--time-limit", "2"}, "0-20000/2");
  EXPECT_EQ(r.code, 5) << r.err;
  const std::string word = "; stopped at frame ";
  const std::size_t at = r.last.find(word);
  ASSERT_NE(at, std::string::npos) << r.err;
  const int frame = std::stoi(r.last.substr(at + word.size()));
  EXPECT_GT(frame, 0);
  EXPECT_TRUE(r.last.ends_with(word + std::to_string(frame) + ": --frames " + std::to_string(frame) +
                               "-20000/2 goes on there"));
  for (int done = 0; done < frame; done += 2)
    EXPECT_EQ(readPicture(path(frameName("glow.####.png", done))).width, 8) << done;
  EXPECT_FALSE(exists(frameName("glow.####.png", frame)));
  const std::string rest = std::to_string(frame - 2) + "-" + std::to_string(frame);
  EXPECT_TRUE(contains(render({}, rest + "/2").last, "(1 frame, 8x4; 1 already there)"));
}

TEST_F(Frames, ThoseWithoutRoomForWordsAreRenderedAgainAndSaySo) {
  const std::string note = "note: .bmp files cannot say how they were made";
  for (int again = 0; again < 2; ++again) {
    const Run r = render({"-o", "f.##.bmp"});
    EXPECT_TRUE(contains(r.last, "(5 frames, 8x4)"));
    EXPECT_TRUE(contains(r.err, note));
    EXPECT_EQ(r.err.find(note), r.err.rfind(note)) << "once is enough";
  }
  EXPECT_EQ(render({"-o", "f.##.bmp", "-q"}).err, "");
  EXPECT_FALSE(contains(render().err, "note:"));
  EXPECT_TRUE(contains(run({"render", "--help"}).out, ".bmp"));
}

TEST_F(Frames, CtrlCLeavesFinishedFrames) {
  write("slow.ray", std::string(kGlow) + "scale(5, sphere { material = { reflective = (0.9, 0.9, 0.9); } })");
  Program program(folder(),
                  {"slow.ray", "-w", "500", "--spp", "9", "--frames", "0-500", "--log-level", "debug"});
  ASSERT_TRUE(program.says("wrote slow.0000.png"));
  program.kill(SIGINT);
  EXPECT_EQ(program.wait(), 4) << program.err();
  EXPECT_TRUE(contains(program.lastLine(), "stopped by the user: wrote slow.0000.png")) << program.err();
  EXPECT_TRUE(contains(program.lastLine(), " of 501 frames"));
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() != ".png") continue;
    for (const auto& [key, text] : readMetadata(entry.path().string())) EXPECT_NE(key, "Incomplete");
  }
}

TEST_F(Frames, CtrlCTwiceSaysWhichFramesAreThere) {
  std::string panes = kPanes;
  panes.insert(panes.find("scale"), "if (time > 0) {\n");
  write("panes.ray", panes + "}\nsphere { }\n");  // the second frame takes years
  Program program(folder(), {"panes.ray", "-w", "8", "-r", "60", "--progress=json", "--frames", "0-9", "-o",
                             "f.#.png", "--log-level", "debug"});
  ASSERT_TRUE(program.says("wrote f.0.png"));
  ASSERT_TRUE(program.says("\"done\":", 2));  // once for the first frame, and within the second
  program.kill(SIGINT);
  ASSERT_TRUE(program.says("Ctrl-C again"));
  program.killAgain(SIGINT);
  EXPECT_EQ(program.wait(), 130);
  EXPECT_TRUE(contains(program.err(),
                       "stopped at once by the user: wrote f.0.png (1 of 10 frames); stopped at "
                       "frame 1: --frames 1-9 goes on there"))
      << program.err();
  EXPECT_FALSE(contains(program.err(), "nothing written")) << program.err();
}

TEST_F(Frames, SayThatNothingMovesOrThatTheTimeIsTheirs) {
  write("still.ray", "SBT-raytracer 1.0\nsphere { material = { emissive = (1, 1, 1); } }");
  const Run still = run({"still.ray", "-w", "8", "--frames", "0-1", "-o", "s.#.png"});
  EXPECT_EQ(still.code, 0) << still.err;
  EXPECT_TRUE(contains(still.err, "nothing in still.ray changes with time")) << still.err;
  EXPECT_FALSE(contains(render().err, "changes with time"));
  write("rain.ray", "SBT-raytracer 1.0\nparticles { velocity = (0, 0, -4); }");
  const Run rain = run({"rain.ray", "-w", "8", "--frames", "12-13", "-o", "r.#.png"});
  EXPECT_EQ(rain.code, 0) << rain.err;
  EXPECT_FALSE(contains(rain.err, "changes with time")) << rain.err;
  const Run timed = run({"still.ray", "-w", "8", "--frames", "0-1", "--time", "2", "-o", "s.#.png"});
  EXPECT_EQ(timed.code, 2);
  EXPECT_TRUE(contains(timed.err, "--frames and --time cannot be given together")) << timed.err;
}

}  // namespace
}  // namespace trace::test
