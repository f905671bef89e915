// A folder for one test alone: tests run side by side.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/os/process.h"

namespace trace::test {

/// Empty at first, and gone with this. Named after the running test and its process.
class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()).generic_string() + "trace_" + test->test_suite_name() +
            "_" + test->name() + "_" + std::to_string(os::processNumber());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::string& path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// May a file be a link? Not under Wine, and on Windows not for everyone.
inline bool hasLinks() {
  const std::string link = testing::TempDir() + "trace_link_" + std::to_string(os::processNumber());
  std::error_code error;
  std::filesystem::create_symlink("nowhere", link, error);
  return !error && std::filesystem::remove(link);
}

/// May a file have any name? Windows allows no quotation mark in it, and no end of a line.
inline bool hasAnyNames() {
  const std::string odd = testing::TempDir() + "trace_\"\n_" + std::to_string(os::processNumber());
  std::error_code error;
  return std::filesystem::create_directory(odd, error) && std::filesystem::remove(odd);
}

/// Skips the calling test, by name, where the file system lacks them.
#define TRACE_NEEDS_LINKS() \
  if (!test::hasLinks()) GTEST_SKIP() << "SKIPPED: no links here"
#define TRACE_NEEDS_ANY_NAMES() \
  if (!test::hasAnyNames()) GTEST_SKIP() << "SKIPPED: names of files are restricted here"

}  // namespace trace::test
