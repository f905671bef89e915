// The files of the folders that grade compares.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace trace {

struct FolderFiles {
  std::vector<std::filesystem::path> files;       ///< wanted, seen from the folder, in the order of names
  std::vector<std::filesystem::path> unreadable;  ///< perhaps wanted: what they hold could not be seen
  std::map<std::filesystem::path, std::string> unreadableFolders;  ///< and why
};

/// What is in and below the folder. Links are followed, but not into a folder that they stand in. `wanted`
/// may throw Error where it cannot tell. Throws Error(Fault::io) if the folder itself cannot be read.
FolderFiles filesBelow(const std::string& folder, bool (*wanted)(const std::filesystem::path&));

/// A to Z as a to z.
std::string lowerCase(std::string text);

/// By the suffix, in any case.
bool isPictureFile(const std::filesystem::path& file);

/// By what it holds. Throws Error(Fault::io).
bool isSceneFile(const std::filesystem::path& file);

}  // namespace trace
