// Students' own programs, run on scenes: what each cell says, and that a second run is the same.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/sandbox.h"
#include "cli/program.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

class GradeRun : public ProgramTest {
 protected:
  GradeRun() {
    fs::create_directories(path("scenes"));
    fs::create_directories(path("ref"));
    write("scenes/white.ray", kWhite);
    EXPECT_EQ(run({"scenes/white.ray", "-w", "16", "-o", "ref/white.png"}).code, 0);
  }
  /// A student whose program is that script.
  void student(const std::string& name, const std::string& script) const {
    fs::create_directories(path("in/" + name));
    write("in/" + name + "/ray", "#!/bin/sh\n" + script + "\n");
    fs::permissions(path("in/" + name + "/ray"), fs::perms::owner_all);
  }
  Run grade(std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"grade",
                                   "--class",
                                   "in",
                                   "--reference",
                                   "ref",
                                   "--scene",
                                   "scenes",
                                   "--run",
                                   "./ray {scene} {out}",
                                   "--scene-limit",
                                   "10",
                                   "-w",
                                   "16",
                                   "-o",
                                   "class.html"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(GradeRun, EachProgramHasItsRow) {
  if (const std::string why = whyNotIsolated(); !why.empty())
    GTEST_SKIP() << "SKIPPED: programs cannot be isolated here: " << why;
  fs::create_directories(path("in/trace"));
  fs::copy_file(rayProgram(), path("in/trace/program"));
  student("trace", "./program \"$1\" -w 16 -o \"$2\" --resume=never");
  student("crashes", "kill -11 $$");
  student("fails", "echo 'cannot parse line 7' >&2; exit 3");
  student("nothing", "true");
  student("damaged", "echo no picture > \"$2\"");
  student("too-large", "head -c 80000000 /dev/zero > \"$2\"");
  student("never-ends", "sleep 1000 & sleep 1000");
  student("spies", "cp ../../ref/white.png \"$2\" || cp '" + path("ref/white.png") + "' \"$2\"");
  const Run first = grade();
  EXPECT_EQ(first.code, 6) << first.err;
  for (const char* row : {"crashes/white.png: its program was ended by a signal",
                          "fails/white.png: its program wrote no picture; its program ended with the exit "
                          "code 3: cannot parse line 7",
                          "nothing/white.png: its program wrote no picture",
                          "damaged/white.png: ", "too-large/white.png: its picture is larger than the 64 MB",
                          "never-ends/white.png: its program takes longer than the 10 s",
                          "spies/white.png: its program wrote no picture"})
    EXPECT_NE(first.out.find(row), std::string::npos) << row << "\n" << first.out;
  EXPECT_NE(first.out.find("1 of 1 within the limits"), std::string::npos) << first.out;
  const std::string page = readFile(path("class.html")), csv = readFile(path("class.csv"));
  EXPECT_NE(page.find(" (Trace "), std::string::npos) << "the times are shown";
  const Run second = grade();
  EXPECT_NE(second.err.find("0 compared now"), std::string::npos) << second.err;
  EXPECT_EQ(readFile(path("class.html")), page);
  EXPECT_EQ(readFile(path("class.csv")), csv);
}

TEST_F(GradeRun, NeedsSceneClassAndPlaceholders) {
  student("a", "true");
  EXPECT_EQ(run({"grade", "in", "--reference", "ref", "--run", "./ray {scene} {out}"}).code, 2);
  EXPECT_EQ(run({"grade", "--class", "in", "--reference", "ref", "--run", "./ray {scene} {out}"}).code, 2);
  EXPECT_EQ(
      run({"grade", "--class", "in", "--reference", "ref", "--scene", "scenes", "--run", "./ray {scene}"})
          .code,
      2);
}

TEST_F(GradeRun, RunsInTheAccountOfTheUserOnlyIfTold) {
  student("a", "cp '" + path("ref/white.png") + "' \"$2\"");
  const Run run = grade({"--unsandboxed"});
  EXPECT_EQ(run.code, 0) << run.out << run.err;
}

}  // namespace
}  // namespace trace::test
