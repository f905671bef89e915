// Programs of strangers: what they cannot do, and that nothing of them is left.
#include "base/sandbox.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/files/file.h"
#include "support/folder.h"

namespace trace::test {
namespace {

/// Skips the calling test, by name and loudly, where the kernel does not isolate programs.
#define TRACE_NEEDS_ISOLATION()                               \
  if (const std::string why = whyNotIsolated(); !why.empty()) \
  GTEST_SKIP() << "SKIPPED: programs cannot be isolated here: " << why

class Sandbox : public testing::Test {
 protected:
  Sandbox() {
    std::filesystem::create_directories(folder_ / "program");
    std::filesystem::create_directories(folder_ / "scenes");
    writeFile(folder_ / "scenes/room.ray", "a scene");
    writeFile(folder_ / "secret", "a secret");
  }
  SandboxJob job(const std::string& command) const {
    SandboxJob job;
    job.command = command;
    job.folder = folder_ / "program";
    job.input = folder_ / "scenes/room.ray";
    job.outputName = "picture.png";
    job.limits.seconds = 20;
    return job;
  }
  const Folder folder_;
};
using End = SandboxResult::End;
using Output = SandboxResult::Output;

TEST_F(Sandbox, GivesTheProgramTheSceneAndTakesThePicture) {
  TRACE_NEEDS_ISOLATION();
  const SandboxResult result = runSandboxed(job("cat {scene} > {out} && echo done; exit 3"));
  EXPECT_EQ(result.end, End::exited) << result.said;
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(result.said, "done\n");
  EXPECT_EQ(result.output, Output::taken);
  EXPECT_EQ(result.bytes, "a scene");
}

TEST_F(Sandbox, RunsWithoutIsolationOnlyWhereThatIsAskedFor) {
  SandboxJob open = job("cat {scene} > {out}");
  open.isolated = false;
  const SandboxResult result = runSandboxed(open);
  EXPECT_EQ(result.end, End::exited) << result.said;
  EXPECT_EQ(result.bytes, "a scene");
}

TEST_F(Sandbox, ReadsAndWritesNothingElse) {
  TRACE_NEEDS_ISOLATION();
  for (const std::string& command :
       {"cat '" + folder_.path() + "/secret'", std::string("cat /etc/passwd"), std::string("ls /home /root"),
        std::string("touch mine"), std::string("touch /scene/mine"), std::string("touch /usr/mine"),
        std::string("mount -t tmpfs none /tmp"), std::string("unshare -r true"),
        std::string("test $(ls /proc/sys/net/ipv4/conf | grep -cv -e lo -e all -e default) != 0"),
        std::string("kill -9 " + std::to_string(::getpid()))}) {
    const SandboxResult result = runSandboxed(job(command));
    EXPECT_EQ(result.end, End::exited) << command;
    EXPECT_NE(result.code, 0) << command << ": " << result.said;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "program/mine"));
  EXPECT_EQ(
      runSandboxed(job("bash -c 'echo > /dev/tcp/127.0.0.1/22' || bash -c 'echo > /dev/tcp/1.1.1.1/80'"))
          .code,
      1);
}

TEST_F(Sandbox, KillsAllThatItStarted) {
  const std::string mark = "86399." + std::to_string(::getpid());
  const auto isRunning = [&] {
    return std::system(("grep -lsaF -- sleep\\\\x00" + mark +
                        " /dev/null; ps -eo args | grep -v grep | grep -qF 'sleep " + mark + "'")
                           .c_str()) == 0;
  };
  for (const bool isolated : {true, false}) {
    if (isolated && !whyNotIsolated().empty()) continue;
    for (const char* end : {"exit 0", "sleep 86400", "kill -9 $$"}) {
      SandboxJob one = job("sleep " + mark + " & setsid sleep " + mark + " & (setsid sh -c 'sleep " + mark +
                           " & sleep " + mark + "' &) ; sleep 0.2; " + end);
      one.isolated = isolated;
      one.limits.seconds = 1;
      const auto begin = std::chrono::steady_clock::now();
      const SandboxResult result = runSandboxed(one);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(15));
      EXPECT_EQ(result.end, end[0] == 'e'   ? End::exited
                            : end[0] == 'k' ? End::killed
                                            : End::timeLimit)
          << end;
      EXPECT_FALSE(isRunning()) << end << (isolated ? " isolated" : "");
    }
  }
}

TEST_F(Sandbox, LimitsTimeMemoryAndTheOutput) {
  for (const bool isolated : {true, false}) {
    if (isolated && !whyNotIsolated().empty()) continue;
    const auto run = [&](const std::string& command) {
      SandboxJob one = job(command);
      one.isolated = isolated;
      one.limits = {.seconds = 2, .memory = std::uint64_t{200} << 20, .output = 1 << 20};
      return runSandboxed(one);
    };
    const SandboxResult busy = run("while :; do :; done");
    EXPECT_EQ(busy.end, End::timeLimit);
    EXPECT_GT(busy.cpuSeconds, 0);
    EXPECT_LT(busy.cpuSeconds, 4);
    const SandboxResult large = run("head -c 3000000 /dev/zero > {out}");
    EXPECT_NE(large.output, Output::taken);
    EXPECT_EQ(run("ln -s /etc/hostname {out}").output, Output::noFile);
    EXPECT_EQ(run("mkdir {out}").output, Output::noFile);
    EXPECT_EQ(run("mkfifo {out}").output, Output::noFile);
    EXPECT_EQ(run("true").output, Output::none);
    const SandboxResult greedy = run("head -c 400000000 /dev/zero | tail > {out}");
    EXPECT_NE(greedy.code, 0) << "400 MB do not fit into 200";
  }
}

}  // namespace
}  // namespace trace::test
