// What writing a file keeps, refuses and leaves behind.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

#include "base/error.h"
#include "base/files/file.h"
#include "support/folder.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

class WriteFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  static mode_t modeOf(const std::string& file) {
    struct stat facts {};
    EXPECT_EQ(::lstat(file.c_str(), &facts), 0);
    return facts.st_mode;
  }
  /// A process of its own that does the work; the caller waits for it.
  static pid_t start(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    work();
    ::_exit(0);
  }

 private:
  const Folder folder_;
};

TEST_F(WriteFile, KeepsTheModeOfWhatItReplaces) {
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    writeFile(path("a"), "old");
    ::chmod(path("a").c_str(), mode);
    writeFile(path("a"), "new");
    EXPECT_EQ(modeOf(path("a")) & 07777, mode);
    EXPECT_EQ(readFile(path("a")), "new");
  }
}

TEST_F(WriteFile, ANewFileHasTheUsualMode) {
  const mode_t before = ::umask(027);
  writeFile(path("a"), "x");
  ::umask(before);
  EXPECT_EQ(modeOf(path("a")) & 07777, 0640u);
}

TEST_F(WriteFile, GoesThroughLinks) {
  fs::create_directory(path("there"));
  writeFile(path("there/a"), "old");
  fs::create_symlink("there/a", path("link"));
  fs::create_symlink("link", path("chain"));
  fs::create_symlink("there/none", path("dangling"));
  writeFile(path("chain"), "new");
  writeFile(path("dangling"), "made");
  for (const char* link : {"link", "chain", "dangling"}) EXPECT_TRUE(fs::is_symlink(path(link))) << link;
  EXPECT_EQ(readFile(path("there/a")), "new");
  EXPECT_EQ(readFile(path("there/none")), "made");
}

TEST_F(WriteFile, RefusesLinksThatLeadNowhere) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  EXPECT_THROW(writeFile(path("a"), "x"), Error);
  EXPECT_THROW(checkWritable(path("a")), Error);
}

TEST_F(WriteFile, RefusesReadOnlyFilesEvenForRoot) {
  writeFile(path("a"), "old");
  ::chmod(path("a").c_str(), 0444);
  fs::create_symlink("a", path("link"));
  for (const char* name : {"a", "link"}) {
    EXPECT_THROW(writeFile(path(name), "new"), Error) << name;
    EXPECT_THROW(checkWritable(path(name)), Error) << name;
  }
  EXPECT_EQ(readFile(path("a")), "old");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(WriteFile, RefusesNamesWithAZero) {
  const std::string name = path("a") + std::string("\0.png", 5);
  writeFile(path("a"), "old");
  EXPECT_THROW(writeFile(name, "new"), Error);
  EXPECT_THROW(readFile(name), Error);
  EXPECT_EQ(readFile(path("a")), "old");
}

TEST_F(WriteFile, APipeTakesTheBytesAndStays) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  checkWritable(path("pipe"));
  std::string read;
  std::thread reader([&] { read = readFile(path("pipe")); });
  writeFile(path("pipe"), "bytes");
  reader.join();
  EXPECT_EQ(read, "bytes");
  EXPECT_TRUE(S_ISFIFO(modeOf(path("pipe"))));
}

TEST_F(WriteFile, AKilledProcessLeavesAWholeFileAndNothingElse) {
  const std::string old(1 << 20, 'a'), fresh(1 << 20, 'b');
  writeFile(path("a"), old);
  for (int i = 0; i < 20; ++i) {
    const pid_t child = start([&] {
      for (;;) writeFile(path("a"), fresh);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(2 + 3 * i));
    ::kill(child, i % 2 ? SIGKILL : SIGTERM);
    ::waitpid(child, nullptr, 0);
    const std::string now = readFile(path("a"));
    EXPECT_TRUE(now == old || now == fresh);
    checkWritable(path("a"));  // what the next run does
    EXPECT_EQ(entries(), 1u);
  }
}

TEST_F(WriteFile, OfTwoProcessesOneIsLast) {
  constexpr int kRounds = 50;
  const std::string a(100000, 'a'), b(200000, 'b');
  writeFile(path("x"), a);
  const auto writing = [&](const std::string& bytes) {
    return start([&] {
      for (int i = 0; i < kRounds; ++i) {
        checkWritable(path("x"));
        writeFile(path("x"), bytes);
      }
    });
  };
  const pid_t children[] = {writing(a), writing(b)};
  for (int i = 0; i < kRounds; ++i) {
    const std::string now = readFile(path("x"));
    EXPECT_TRUE(now == a || now == b) << now.size();
  }
  for (const pid_t child : children) {
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFile, LeftoversOfTheDeadGoAndThoseOfTheLivingStay) {
  const std::string dead = path(".trace-0123456789abcdef.tmp"), living = path(".trace-fedcba9876543210.tmp");
  for (const char* other : {".trace-0123.tmp", ".trace-0123456789abcdeX.tmp", "trace-0123456789abcdef.tmp"})
    writeFile(path(other), "not ours");
  writeFile(path("precious"), "kept");
  fs::create_symlink("precious", path(".trace-00000000000000ff.tmp"));
  writeFile(dead, "half");
  writeFile(living, "half");
  const int held = ::open(living.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(held, LOCK_EX | LOCK_NB), 0);
  checkWritable(path("a.png"));
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(living));
  EXPECT_EQ(readFile(path("precious")), "kept");
  EXPECT_EQ(entries(), 6u);
  ::close(held);
  checkWritable(path("a.png"));
  EXPECT_FALSE(fs::exists(living));
}

TEST_F(WriteFile, AFullDiskLeavesTheOldFile) {
  writeFile(path("a"), "old");
  const pid_t child = start([&] {  // a limit of size stands for a disk that is full
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writeFile(path("a"), std::string(100000, 'x'));
      ::_exit(1);
    } catch (const Error&) {
      ::_exit(2);
    }
  });
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(readFile(path("a")), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(WriteFile, OwnFoldersAreNobodyElses) {
  const std::string a = makeOwnFolder(), b = makeOwnFolder();
  EXPECT_NE(a, b);
  EXPECT_EQ(modeOf(a) & 07777, 0700u);
  fs::remove(a), fs::remove(b);
}

TEST_F(WriteFile, SameFileSeesThroughSpellings) {
  writeFile(path("a"), "x");
  writeFile(path("b"), "x");
  fs::create_symlink("a", path("link"));
  fs::create_hard_link(path("a"), path("hard"));
  for (const char* other : {"a", "./a", "link", "hard"})
    EXPECT_TRUE(sameFile(path("a"), path(other))) << other;
  EXPECT_FALSE(sameFile(path("a"), path("b")));
  EXPECT_TRUE(sameFile(path("none"), path("./none")));
  EXPECT_FALSE(sameFile(path("none"), path("a")));
  EXPECT_FALSE(sameFile(path("none"), path("nothing")));
}

}  // namespace
}  // namespace trace::test
