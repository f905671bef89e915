// ray farm, with programs that stand for Slurm's: sbatch keeps the tasks of an array, and each squeue runs
// one of them before it answers. tests/cluster/slurm.sh has the real ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "program.h"

namespace trace::farm_test {
namespace {

using namespace trace::test;

class Farm : public ProgramTest {
 protected:
  static constexpr const char* kScene = R"(SBT-raytracer 1.0
camera { position = (0,0,6); viewdir = (0,0,-1); updir = (0,1,0); }
translate(0,3,2, scale(2, square { material = { emissive = (4,4,4); } }))
sphere { material = { diffuse = (0.6,0.3,0.2); reflective = (0.4,0.4,0.4); } }
translate(1.2,0,0, scale(0.7, sphere { material = { transmissive = (0.9,0.9,0.9); index = 1.5; } }))
)";

  Farm() {
    std::filesystem::create_directories(path("bin"));
    std::filesystem::create_directories(path("slurm"));
    write("ball.ray", kScene);
    // --array=1-3,5 becomes the files 1, 2, 3 and 5.
    program("sbatch", R"sh(echo "$@" >>"$slurm/submitted"
[ ! -e "$slurm/refuses" ] || { echo "sbatch: error: Invalid account"; exit 1; }
for word; do
  case "$word" in
    --array=*) list=${word#--array=} ;;
    --chdir=*) cd "${word#--chdir=}" ;;
  esac
  script=$word
done
echo "$script" >"$slurm/script"
for range in $(echo "$list" | tr , ' '); do
  for task in $(seq "${range%-*}" "${range#*-}"); do : >"$slurm/task.$task"; done
done
echo 17)sh");
    // A task whose number is a line of the file "lost" goes without a trace; so does one that fails.
    program("squeue", R"sh(echo "$@" >>"$slurm/asked"
[ ! -e "$slurm/silent" ] || { rm "$slurm/silent"; echo "slurm_load_jobs error: Unable to contact slurm controller"; exit 1; }
if [ ! -e "$slurm/holds" ]; then
  for file in "$slurm"/task.*; do
    [ -e "$file" ] || break
    task=${file##*.}
    rm "$file"
    if grep -qx "$task" "$slurm/lost" 2>/dev/null; then
      sed -i "0,/^$task\$/{/^$task\$/d}" "$slurm/lost"
    else
      SLURM_ARRAY_TASK_ID=$task sh "$(cat "$slurm/script")" 2>>"$slurm/log" || true
    fi
    break
  done
fi
for file in "$slurm"/task.*; do [ ! -e "$file" ] || echo "${file##*.}"; done)sh");
  }

  void program(const std::string& name, const std::string& text) const {
    write("bin/" + name, "#!/bin/sh\nset -eu\nslurm='" + path("slurm") + "'\n" + text + "\n");
    std::filesystem::permissions(path("bin/" + name), std::filesystem::perms::owner_all);
  }
  Variables variables() const { return {{"PATH", path("bin") + ":" + std::getenv("PATH")}}; }

  std::vector<std::string> words(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"farm", "ball.ray", "--parts", "3", "-w", "80", "-o", "out.png"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Run farm(const std::vector<std::string>& more = {}) const { return run(words(more), variables()); }
  std::string bytes(const std::string& name) const { return readFile(path(name)); }
  long submissions() const {
    const std::string all = bytes("slurm/submitted");
    return std::count(all.begin(), all.end(), '\n');
  }
  void expectWhole(const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> one{"ball.ray", "-w", "80", "-o", "whole.png"};
    one.insert(one.end(), flags.begin(), flags.end());
    ASSERT_EQ(run(one).code, 0);
    EXPECT_EQ(bytes("out.png"), bytes("whole.png"));
  }
};

TEST_F(Farm, GivesTheBytesOfOneMachineByEveryIntegrator) {
  const std::vector<std::vector<std::string>> all{
      {"--integrator", "path", "--spp", "4"},
      {"--integrator", "bdpt", "--spp", "4"},
      {"--integrator", "mlt", "--chain-starts", "1000", "--spp", "4"},
      {"--integrator", "photon", "--photons", "2000", "--spp", "4"}};
  for (const std::vector<std::string>& flags : all) {
    SCOPED_TRACE(flags[1]);
    std::filesystem::remove_all(path("out.parts"));
    const Run r = farm(flags);
    ASSERT_EQ(r.code, 0) << r.err << bytes("slurm/log");
    EXPECT_TRUE(contains(r.err, "submitted tasks 1-3, job 17"));
    EXPECT_TRUE(contains(r.last, "wrote out.png"));
    expectWhole(flags);
  }
}

TEST_F(Farm, SubmitsLostTasksAgain) {
  write("slurm/lost", "1\n3\n3\n");
  const Run r = farm({"--sbatch", "--partition=short --job-name=mine"});
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.err, "lost and submitted again: task 1, job 17"));
  EXPECT_TRUE(contains(r.err, "lost and submitted again: task 3, job 17"));
  EXPECT_EQ(submissions(), 4);
  const std::string flags = bytes("slurm/submitted");
  EXPECT_TRUE(contains(flags, "--partition=short --job-name=mine --parsable --job-name=ray-"));
  EXPECT_TRUE(contains(flags, "--array=3 "));
  const std::string name = flags.substr(flags.find("--job-name=ray-") + 11, 20);
  EXPECT_TRUE(contains(bytes("slurm/asked"), "--name=" + name));
  expectWhole();
}

TEST_F(Farm, ShowsHowFarAllOfItIs) {
  const Run r = farm({"--progress", "json"});
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.err, "\"done\":0,\"total\":3,"));
  EXPECT_TRUE(contains(r.err, "\"done\":3,\"total\":3,\"fraction\":1,"));
  EXPECT_TRUE(contains(r.err, "\"remaining\":0}"));
}

TEST_F(Farm, ContinuesAfterTheDeathOfTheProcessThatSubmitted) {
  write("slurm/holds", "");
  Program program(folder(), words(), variables());
  ASSERT_TRUE(program.says("submitted tasks 1-3, job 17"));
  program.kill(SIGKILL);
  program.wait();
  std::filesystem::remove(path("slurm/holds"));
  std::filesystem::remove(path("slurm/task.2"));  // and one is lost in the meantime
  const Run r = farm();
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.err, "continuing: 1 task of an earlier run in the queue"));
  EXPECT_TRUE(contains(bytes("slurm/submitted"), "--array=2 "));
  EXPECT_EQ(submissions(), 2);
  expectWhole();
}

TEST_F(Farm, CtrlCLeavesTheJobs) {
  write("slurm/holds", "");
  Program program(folder(), words(), variables());
  ASSERT_TRUE(program.says("submitted tasks 1-3, job 17"));
  program.kill(SIGINT);
  EXPECT_EQ(program.wait(), 4);
  EXPECT_TRUE(contains(program.lastLine(),
                       "the jobs are still rendered, and the same command continues; scancel --name=ray-"));
  EXPECT_TRUE(exists("slurm/task.2"));
  EXPECT_FALSE(exists("out.png"));
}

TEST_F(Farm, ATaskThatFailsAgainAndAgainIsNamed) {
  write("slurm/lost", "2\n2\n2\n2\n");
  const Run r = farm();
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "out.parts/slurm-2.log: error: task 2 ended 3 times without writing a part"));
  EXPECT_TRUE(exists("out.parts/1.part") && exists("out.parts/3.part"));
  EXPECT_FALSE(exists("out.png"));
  write("slurm/lost", "");
  EXPECT_EQ(farm().code, 0) << "the same command tries again";
  expectWhole();
}

TEST_F(Farm, WaitsForASlurmThatIsSilentAwhile) {
  write("slurm/holds", "");
  Program program(folder(), words(), variables());
  ASSERT_TRUE(program.says("submitted tasks 1-3, job 17"));
  write("slurm/silent", "");
  EXPECT_TRUE(program.says("warning: Slurm does not answer: slurm_load_jobs error"));
  std::filesystem::remove(path("slurm/holds"));
  EXPECT_EQ(program.wait(), 0) << program.err();
  EXPECT_EQ(submissions(), 1) << "nothing is lost because nobody answers";
  expectWhole();
}

TEST_F(Farm, WithoutSlurmSaysWhatToDo) {
  write("slurm/silent", "");
  Run r = farm();
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "Slurm does not answer: slurm_load_jobs error"));
  EXPECT_TRUE(contains(r.err, "-j 4 renders the parts without Slurm"));
  EXPECT_FALSE(exists("slurm/submitted"));
  write("slurm/refuses", "");
  r = farm();
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.err, "sbatch refused the job array: sbatch: error: Invalid account"));
  EXPECT_TRUE(contains(run({"farm", "ball.ray"}).err, "ray farm: expected --parts N, found none"));
  EXPECT_TRUE(contains(run({"farm"}).err, "ray farm: expected one scene, found 0 names"));
}

TEST_F(Farm, FramesAreParts) {
  const Run r = run({"farm", "ball.ray", "-w", "40", "--frames", "1-3", "-o", "f.##.png"}, variables());
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(exists("f.parts/3.part"));
  ASSERT_EQ(run({"render", "ball.ray", "-w", "40", "--frames", "1-3", "-o", "w.##.png"}).code, 0);
  for (const char* number : {"01", "02", "03"})
    EXPECT_EQ(bytes("f." + std::string(number) + ".png"), bytes("w." + std::string(number) + ".png"));
}

}  // namespace
}  // namespace trace::farm_test
