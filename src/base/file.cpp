#include "base/file.h"

#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace trace {
namespace fs = std::filesystem;
std::string readBeside(const std::string& from, const std::string& name) {
  const std::string path = besideFile(from, name);
  std::error_code ignored;
  if (fs::exists(path, ignored) && !isOrdinaryFile(path))
    throw Error(Fault::io, "cannot read \"" + path + "\": it is no ordinary file");
  return readFile(path);
}

std::string besideFile(const std::string& from, const std::string& name) {
  const fs::path path(name);
  return path.is_absolute() ? name : (fs::path(from).parent_path() / path).string();
}

std::string findFile(const std::string& from, const std::string& name) {
  constexpr int kFoldersAbove = 3;
  std::error_code ignored;
  if (fs::is_regular_file(name, ignored)) return name;
  fs::path folder = fs::path(from).parent_path();
  for (int i = 0; i <= kFoldersAbove; ++i, folder /= "..")
    if (const fs::path path = folder / name; fs::is_regular_file(path, ignored)) return path.string();
  return besideFile(from, name);
}

}  // namespace trace
