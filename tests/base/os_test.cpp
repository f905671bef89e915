// What every operating system gives.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "base/files/file.h"
#include "base/os/interrupts.h"
#include "base/os/memory.h"
#include "base/os/process.h"
#include "base/os/temporary_name.h"
#include "support/folder.h"

namespace trace::os_test {
namespace {

TEST(OperatingSystem, KnowsTheProcess) {
  EXPECT_TRUE(std::filesystem::is_directory(os::ownFolder())) << os::ownFolder();
  EXPECT_EQ(os::ownFolder().find('\\'), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(os::programIn(os::ownFolder(), "test_base")));
  EXPECT_NE(os::processNumber(), 0u);
  EXPECT_NE(os::variable("PATH"), "");
  EXPECT_EQ(os::variable("TRACE_NOBODY_SETS_THIS"), "");
}

TEST(OperatingSystem, ProgramsAnswer) {
  const std::string own = os::programIn(os::ownFolder(), "test_base");
  const os::ProgramAnswer list = os::answerOf({own, "--gtest_list_tests", "--gtest_filter=*.ProgramsAns*"});
  EXPECT_EQ(list.code, 0);
  EXPECT_NE(list.text.find("ProgramsAnswer"), std::string::npos) << list.text;
  EXPECT_EQ(list.text.find("KnowsMemory"), std::string::npos) << list.text;
  const std::string odd =
      os::answerOf({own, "--gtest_list_tests", "--gtest_filter=a 'b $HOME:*.ProgramsA*"}).text;
  EXPECT_NE(odd.find("ProgramsAnswer"), std::string::npos) << "a word is cut or changed: " << odd;
  const os::ProgramAnswer none = os::answerOf({"trace-nobody-has-this"});
  EXPECT_NE(none.code, 0);
  EXPECT_NE(none.text, "");
}

TEST(OperatingSystem, KnowsMemory) {
  EXPECT_GT(os::machineMemory(), os::peakMemory());
  EXPECT_GT(os::peakMemory(), std::uint64_t{100} << 10);
}

TEST(OperatingSystem, CountsTheTimeOfProcessorsOnly) {
  const double begin = os::cpuSeconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_LT(os::cpuSeconds() - begin, 0.3);
  volatile double sum = 0;
  while (os::cpuSeconds() - begin < 0.05) sum = sum + 1;
  EXPECT_GT(sum, 0);
}

TEST(OperatingSystem, BellsKeepMessagesInTheirOrder) {
  os::Bell bell;
  EXPECT_EQ(bell.wait(1), 0);
  bell.ring('a'), bell.ring('b');
  EXPECT_EQ(bell.wait(1), 'a');
  EXPECT_EQ(bell.wait(1), 'b');
  std::thread other([&] { bell.ring('c'); });
  EXPECT_EQ(bell.wait(60000), 'c');
  other.join();
  EXPECT_EQ(bell.wait(1), 0);
}

TEST(OperatingSystem, NamesOfFilesAreUtf8) {
  const test::Folder folder;
  for (const char* name : {"Gl\u00fcck", "\u65e5\u672c", "\U0001f600 face", "plain"}) {
    const std::string path = folder / name;
    writeFile(path, name);
    EXPECT_TRUE(std::filesystem::exists(path)) << path;
    EXPECT_EQ(std::filesystem::path(path).filename().generic_string(), name);
    const std::filesystem::directory_iterator first(folder.path());
    EXPECT_EQ(first->path().filename().generic_string(), name);
    EXPECT_EQ(readFile(path), name);
    std::filesystem::remove(path);
  }
}

TEST(OperatingSystem, TemporaryNamesAreKnownAgain) {
  const std::filesystem::path name = os::temporaryName("folder");
  EXPECT_EQ(name.parent_path(), "folder");
  EXPECT_TRUE(os::isTemporaryName(name.filename().generic_string())) << name;
  for (const char* other :
       {"", ".trace-0123.tmp", ".trace-0123456789abcdeX.tmp", "trace-0123456789abcdef.tmp"})
    EXPECT_FALSE(os::isTemporaryName(other)) << other;
}

// Some C libraries round the product too, or go by a wider type, which has no room for all of its bits.
TEST(OperatingSystem, FusedMultiplicationRoundsOnce) {
  volatile double a = 1 + 0x1p-30, b = 1 + 0x1p-52, tiny = 0x1p-80;
  EXPECT_EQ(std::fma(a, a, -(a * a)), 0x1p-60);
  EXPECT_EQ(std::fma(b, b, -(b * b)), 0x1p-104);
  EXPECT_EQ(std::fma(b, 1.0, tiny), b);
  EXPECT_EQ(std::fma(a, 3.0, -3 * a), 0);
  EXPECT_EQ(std::fma(a, -a, a * a), -0x1p-60);
}

}  // namespace
}  // namespace trace::os_test
