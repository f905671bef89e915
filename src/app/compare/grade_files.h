// The files of the folders that grade compares.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace trace {

struct FolderFiles {
  std::vector<std::filesystem::path> files;  ///< wanted, seen from the folder, in the order of names
  std::vector<std::filesystem::path>
      others;  ///< perhaps meant to be wanted: who reads one learns why it is not
  std::vector<std::filesystem::path> noFiles;  ///< pipes and devices, which must not be read
  std::map<std::filesystem::path, std::string> unreadableFolders;  ///< and why
};

/// The result of a test of a file for some kind of it.
enum class FileKind { wanted, perhaps, unwanted };

/// The files in and below the folder. `kindOf` reads no pipe and no device. Links are followed, but not into
/// a folder that they stand in. Throws Error(Fault::io) if the folder itself cannot be read.
FolderFiles filesBelow(const std::string& folder, FileKind (*kindOf)(const std::filesystem::path&));

/// A to Z as a to z.
std::string lowerCase(std::string text);

/// The kind of a picture, by its suffix in any case.
FileKind pictureKind(const std::filesystem::path& file);

/// In any case.
bool hasSceneSuffix(const std::filesystem::path& file);

/// The kind of a scene, by what it holds. A file that no format recognises or nobody can read is perhaps a
/// scene; a picture is not.
FileKind sceneKind(const std::filesystem::path& file);

}  // namespace trace
