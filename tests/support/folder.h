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
    path_ = testing::TempDir() + "trace_" + test->test_suite_name() + "_" + test->name() + "_" +
            std::to_string(os::processNumber());
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

}  // namespace trace::test
