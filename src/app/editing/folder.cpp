#include "app/editing/folder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/error.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string problemOf(const std::string& folder, const std::error_code& error) {
  if (error == std::errc::no_such_file_or_directory) return "there is no folder \"" + folder + '"';
  if (error == std::errc::not_a_directory) return '"' + folder + "\" is no folder";
  return "the folder \"" + folder + "\" cannot be read: " + error.message();
}

}  // namespace

std::string folderProblem(const std::string& path) {
  std::error_code error;
  const fs::directory_iterator begins(path, error);
  return error ? problemOf(path, error) : "";
}

std::vector<FolderEntry> listFolder(const std::string& path, const std::vector<std::string>& suffixes) {
  std::error_code error;
  std::vector<FolderEntry> entries;
  for (fs::directory_iterator i(path, error), end; !error && i != end; i.increment(error)) {
    std::error_code ignored;
    const std::string name = i->path().filename().generic_string();
    if (name.starts_with(".")) continue;
    const bool folder = i->is_directory(ignored);
    const auto fits = [&](const std::string& suffix) { return lower(name).ends_with(suffix); };
    if (!folder && !suffixes.empty() && std::none_of(suffixes.begin(), suffixes.end(), fits)) continue;
    const std::uint64_t bytes = folder ? 0 : i->file_size(ignored);
    entries.push_back({name, folder, ignored ? 0 : bytes});
  }
  if (error) throw Error(Fault::io, problemOf(path, error));
  std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
    if (a.folder != b.folder) return a.folder;
    const std::string x = lower(a.name), y = lower(b.name);
    return x != y ? x < y : a.name < b.name;
  });
  return entries;
}

std::string withSuffix(const std::string& name, const std::string& suffix) {
  return fs::path(name).has_extension() ? name : name + suffix;
}

std::string endingProblem(const std::string& name, const std::vector<std::string>& suffixes) {
  const std::string ending = lower(fs::path(name).extension().generic_string());
  if (std::find(suffixes.begin(), suffixes.end(), ending) != suffixes.end()) return "";
  std::string text = "the name must end in ";
  for (std::size_t i = 0; i < suffixes.size(); ++i)
    text += (i == 0 ? "" : i + 1 < suffixes.size() ? ", " : " or ") + suffixes[i];
  return text + ", found \"" + fs::path(name).filename().generic_string() + '"';
}

std::string absoluteFolder(const std::string& path) {
  std::error_code ignored;
  return fs::absolute(path.empty() ? "." : path, ignored).lexically_normal().generic_string();
}

std::string nearestFolder(const std::string& path) {
  std::error_code error;
  fs::path folder = path.empty() ? fs::current_path(error) : fs::absolute(path, error);
  while (!fs::is_directory(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder.lexically_normal().generic_string();
}

}  // namespace trace
