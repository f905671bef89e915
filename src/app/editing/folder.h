// The entries of a folder in a file browser.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trace {

struct FolderEntry {
  std::string name;
  bool folder = false;
  std::uint64_t bytes = 0;  ///< size of a file in bytes
  bool operator==(const FolderEntry&) const = default;
};

/// Folders first, then files that end in one of the suffixes (in any case; none given: all), each by name
/// without regard to case. Hidden ones are left out. Throws Error(Fault::io).
std::vector<FolderEntry> listFolder(const std::string& path, const std::vector<std::string>& suffixes);

/// The name with that suffix if it has none.
std::string withSuffix(const std::string& name, const std::string& suffix);

/// Why no file of that name can be written, where its name must end in one of the suffixes (in any case), in
/// words; "" if it does.
std::string endingProblem(const std::string& name, const std::vector<std::string>& suffixes);

/// Why the files of the folder cannot be listed, in words; "" if they can.
std::string folderProblem(const std::string& path);

/// The path from the root, without "." and "..".
std::string absoluteFolder(const std::string& path);

/// The folder itself, or the nearest one above that exists; the current folder for "".
std::string nearestFolder(const std::string& path);

}  // namespace trace
