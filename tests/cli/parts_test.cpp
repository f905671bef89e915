// One picture by several machines: ray split, ray render --part, ray merge.
#include <gtest/gtest.h>

#include <cstdlib>

#include "program.h"

namespace trace::test {
namespace {

class Parts : public ProgramTest {
 protected:
  static constexpr const char* kScene = R"(SBT-raytracer 1.0
camera { position = (0,0,6); viewdir = (0,0,-1); updir = (0,1,0); }
directional_light { direction = (-1,-1,-2); color = (1,1,1); }
translate(0,3,2, scale(2, square { material = { emissive = (4,4,4); } }))
sphere { material = { diffuse = (0.6,0.3,0.2); reflective = (0.4,0.4,0.4); ambient = (0.1,0.1,0.1); } }
translate(1.2,0,0, scale(0.7, sphere { material = { transmissive = (0.9,0.9,0.9); index = 1.5; } }))
)";
  Parts() { write("ball.ray", kScene); }

  static std::vector<std::string> joined(std::vector<std::string> words,
                                         const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string bytes(const std::string& name) const { return readFile(path(name)); }
  void split(int parts, const std::vector<std::string>& flags = {"-w", "80"}) const {
    std::filesystem::remove_all(path("p"));
    const Run r = run(joined({"split", "ball.ray", "-o", "p", "--parts", std::to_string(parts)}, flags));
    ASSERT_EQ(r.code, 0) << r.err;
  }
  /// As make does it.
  int job(int number, const std::string& threads = "1") const {
    const std::string command = "cd '" + path("p") + "' && RAY_THREADS=" + threads + " sh ./render.sh " +
                                std::to_string(number) + " 2>../job.txt";
    return std::system(command.c_str());
  }
  /// The last job first.
  void renderAll(int jobs) const {
    const char* kThreads[] = {"1", "2", "7"};
    for (int i = jobs; i >= 1; --i) ASSERT_EQ(job(i, kThreads[i % 3]), 0) << bytes("job.txt");
  }
  void expectSame(int parts, const std::vector<std::string>& flags) const {
    SCOPED_TRACE(parts);
    split(parts, flags);
    renderAll(parts);
    const Run r = run({"merge", "p", "-o", "out.png"});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
  }
};

TEST_F(Parts, AreTheBytesOfOneMachineByEveryIntegrator) {
  const std::vector<std::vector<std::string>> all{
      {"--integrator", "whitted", "--spp", "4", "--auto-exposure"},
      {"--integrator", "path", "--spp", "8", "--sampling", "sobol", "--denoise"},
      {"--integrator", "path", "--spp", "64", "--noise-target", "0.05"},
      {"--integrator", "bdpt", "--spp", "4"},
      {"--integrator", "photon", "--photons", "2000", "--spp", "4"},
      {"--integrator", "mlt", "--chain-starts", "1000", "--spp", "4"},
  };
  for (const std::vector<std::string>& one : all) {
    SCOPED_TRACE(one[1] + " " + one.back());
    const std::vector<std::string> flags = joined({"-w", "80"}, one);
    ASSERT_EQ(run(joined({"ball.ray", "whole.png"}, flags)).code, 0);
    for (const int parts : {1, 2, 5}) expectSame(parts, flags);
  }
}

TEST_F(Parts, ARegionAndPassesAreThoseOfOneMachine) {
  const std::vector<std::string> flags{"-w",       "100",   "--region",     "20,10,90,80",
                                       "--passes", "depth", "--integrator", "bdpt"};
  ASSERT_EQ(run(joined({"ball.ray", "whole.png"}, flags)).code, 0);
  expectSame(3, flags);
  EXPECT_EQ(bytes("out.depth.exr"), bytes("whole.depth.exr"));
}

TEST_F(Parts, FramesAreThoseOfOneMachine) {
  write("ball.ray", std::string(kScene) + "translate(key((0, 0), (2, 1)), 1, 1) { sphere { } }\n");
  const std::vector<std::string> flags{"-w", "64", "--frames", "2-6/2", "--fps", "2"};
  ASSERT_EQ(run(joined({"render", "ball.ray", "-o", "whole.##.png"}, flags)).code, 0);
  for (const int parts : {1, 2}) {
    split(parts, flags);
    renderAll(3 * parts);
    const Run r = run({"merge", "p", "-o", "out.##.png"});
    ASSERT_EQ(r.code, 0) << r.err;
    for (const char* number : {"02", "04", "06"})
      EXPECT_EQ(bytes("out." + std::string(number) + ".png"), bytes("whole." + std::string(number) + ".png"));
  }
  EXPECT_NE(bytes("out.02.png"), bytes("out.06.png"));
}

TEST_F(Parts, MissingDoubledAndForeignOnesAreNamed) {
  split(5);
  Run r = run({"merge", "p", "-o", "out.png"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "parts 1, 2, 3, 4 and 5 of 5 are missing"));
  renderAll(5);
  std::filesystem::rename(path("p/2.part"), path("p/machine-b.part"));  // whatever it is called
  std::filesystem::copy(path("p/4.part"), path("p/copy.part"));
  r = run({"merge", "p", "-o", "out.png"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "part 4 is there twice"));
  std::filesystem::remove(path("p/copy.part"));
  std::filesystem::rename(path("p/3.part"), path("3.part"));
  r = run({"merge", "p", "-o", "out.png"});
  EXPECT_TRUE(contains(r.err, "part 3 of 5 is missing"));
  ASSERT_EQ(run({"ball.ray", "-w", "80", "--depth", "1", "--part", "3/5", "-o", "p/3.part"}).code, 0);
  r = run({"merge", "p", "-o", "out.png"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "--depth differs"));
  std::filesystem::rename(path("3.part"), path("p/3.part"));
  EXPECT_FALSE(exists("out.png"));
  EXPECT_EQ(run({"merge", "p", "-o", "out.png"}).code, 0);
  write("ball.ray", std::string(kScene) + "// edited");
  r = run({"merge", "p", "-o", "out.png"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "the scene has changed"));
}

TEST_F(Parts, ThatAreBrokenAreRefused) {
  split(2);
  renderAll(2);
  const std::string good = bytes("p/2.part");
  std::string changed = good;
  changed.back() = static_cast<char>(changed.back() ^ 1);
  for (const std::string& broken :
       {changed, good.substr(0, good.size() / 2), std::string("no part"), std::string()}) {
    write("p/2.part", broken);
    const Run r = run({"merge", "p", "-o", "out.png"});
    EXPECT_EQ(r.code, 1);
    EXPECT_TRUE(contains(r.err, "p/2.part: error: "));
    EXPECT_FALSE(exists("out.png"));
  }
  ASSERT_EQ(job(2), 0) << "a broken part is rendered again";
  EXPECT_EQ(bytes("p/2.part"), good);
  ASSERT_EQ(job(2), 0);
  EXPECT_TRUE(contains(bytes("job.txt"), "already there"));
  write("p/parts.list", "Trace parts 1\nparts 0\nword x\n");
  EXPECT_TRUE(contains(run({"merge", "p"}).err, "parts.list:2:1: error: expected \"parts N\""));
}

TEST_F(Parts, GoOnFromTheirCheckpoint) {
  const std::vector<std::string> flags{"-w",           "100",  "--spp",      "400",
                                       "--integrator", "path", "--sampling", "sobol"};
  const std::vector<std::string> one = joined({"ball.ray", "--part", "1/2", "-o"}, {});
  ASSERT_EQ(run(joined(joined(one, {"a.part"}), flags)).code, 0);
  const Run stopped = run(joined(joined(one, {"b.part", "-t", "1", "--time-limit", "0.05"}), flags));
  ASSERT_EQ(stopped.code, 5) << stopped.err;
  EXPECT_FALSE(exists("b.part"));
  ASSERT_TRUE(exists("b.part.checkpoint")) << stopped.err;
  const Run other = run(joined({"ball.ray", "--part", "2/2", "-o", "b.part", "--time-limit", "0.01"}, flags));
  EXPECT_FALSE(contains(other.err, "continuing")) << "the checkpoint of another part";
  const Run rest = run(joined(joined(one, {"b.part"}), flags));
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_TRUE(contains(rest.err, "continuing from b.part.checkpoint"));
  EXPECT_EQ(bytes("b.part"), bytes("a.part"));
}

TEST_F(Parts, WhatCannotBeDividedIsRefused) {
  EXPECT_TRUE(contains(run({"split", "ball.ray", "--parts", "2", "--subdivide", "2"}).err,
                       "--subdivide compares each pixel"));
  EXPECT_TRUE(contains(run({"split", "ball.ray", "--parts", "9", "-w", "40"}).err,
                       "and cannot be divided into 9 parts"));
  const Run picture = run({"ball.ray", "-w", "40", "--part", "1/2", "-o", "p.png"});
  EXPECT_EQ(picture.code, 2);
  EXPECT_TRUE(contains(picture.err, "--part: expected a name that ends in .part, found \"p.png\""))
      << picture.err;
  EXPECT_TRUE(contains(run({"ball.ray", "-w", "40", "--part", "1/9"}).err, "choose at most 4 parts"));
  EXPECT_TRUE(
      contains(run({"ball.ray", "--part", "3/2"}).err, "--part: expected a whole number from 1 to 2"));
  EXPECT_TRUE(contains(run({"split", "ball.ray"}).err, "expected --parts N"));
  split(2);
  EXPECT_EQ(run({"split", "ball.ray", "-o", "p", "--parts", "2", "-w", "80"}).code, 0);
  EXPECT_TRUE(contains(run({"split", "ball.ray", "-o", "p", "--parts", "3", "-w", "80"}).err,
                       "holds the parts of another render"));
}

TEST_F(Parts, ScriptsQuoteEveryWord) {
  std::filesystem::create_directory(path("it's $HOME"));
  write("it's $HOME/a b.ray", kScene);
  ASSERT_EQ(run({"split", "it's $HOME/a b.ray", "-o", "p", "--parts", "2", "-w", "64"}).code, 0);
  renderAll(2);
  ASSERT_EQ(run({"merge", "p", "-o", "out.png"}).code, 0);
  ASSERT_EQ(run({"it's $HOME/a b.ray", "whole.png", "-w", "64"}).code, 0);
  EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
}

TEST_F(Parts, ASlurmTaskRendersWhatIsMissingOfItsJobs) {
  split(3);
  ASSERT_EQ(job(2), 0);
  const auto before = std::filesystem::last_write_time(path("p/2.part"));
  for (const char* task : {"1", "2", "3"}) {
    const std::string command =
        std::string("SLURM_ARRAY_TASK_ID=") + task + " sh '" + path("p/farm.slurm") + "' 2>/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  EXPECT_EQ(std::filesystem::last_write_time(path("p/2.part")), before);
  EXPECT_EQ(run({"merge", "p", "-o", "out.png"}).code, 0);
  EXPECT_TRUE(contains(bytes("p/farm.slurm"), "#SBATCH --array=1-3\n"));
}

TEST_F(Parts, MakeRendersThemAll) {
  if (std::system("command -v make >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no make";
  split(5);
  const std::string make = "make -s -j 3 -C '" + path("p") + "' >/dev/null 2>&1";
  ASSERT_EQ(std::system(make.c_str()), 0);
  EXPECT_EQ(run({"merge", "p", "-o", "out.png"}).code, 0);
}

}  // namespace
}  // namespace trace::test
