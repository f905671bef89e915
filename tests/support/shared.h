// Real scenes and pictures that lie outside the repository. Tests that need them skip when they are absent.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "support/paths.h"

namespace trace::test {

/// Skips the calling test, by name and loudly, when `folder` of the shared material is not there.
#define TRACE_NEEDS_SHARED(folder)                                           \
  if (!std::filesystem::is_directory(test::sharedFolder() + "/" + (folder))) \
  GTEST_SKIP() << "SKIPPED: needs the shared material in " << test::sharedFolder() << "/" << (folder)

/// Without the scenes of many instances: as text, as it is written and read again, they have up to a million
/// lines.
inline std::vector<std::string> filesUnder(const std::string& folder, const std::string& suffix) {
  const auto isLarge = [](const std::filesystem::path& path) {
    return path.filename() == "forest.ray" || path.filename() == "city.ray";
  };
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none))
    if (entry.is_regular_file() && entry.path().extension() == suffix && !isLarge(entry.path()))
      files.push_back(entry.path().generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace trace::test
