#include "base/files/file.h"

#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "base/files/read_scope.h"

namespace trace {

namespace fs = std::filesystem;

std::string readBeside(const std::string& from, const std::string& name) {
  const std::string path = besideFile(from, name);
  checkMayRead(path);
  std::error_code ignored;
  if (fs::exists(path, ignored) && !isOrdinaryFile(path))
    throw Error(Fault::io, "cannot read \"" + path + "\": it is no ordinary file");
  return readFile(path);
}

bool mayNameFile(const std::string& name) {
  try {
    const fs::path path(name);
    return true;
  } catch (const fs::filesystem_error&) {
    return false;
  }
}

std::string besideFile(const std::string& from, const std::string& name) {
  if (!mayNameFile(name)) throw Error(Fault::io, "\"" + name + "\" names no file here: it is not UTF-8");
  const fs::path path(name);
  return path.is_absolute() ? name : (fs::path(from).parent_path() / path).generic_string();
}

std::string nameFrom(const std::string& folder, const std::string& path) {
  const fs::path way = fs::path(path).lexically_relative(folder);
  return (way.empty() ? fs::path(path) : way).generic_string();
}

bool sameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  if (fs::exists(a, error) || fs::exists(b, error)) return false;
  const fs::path first = fs::weakly_canonical(a, error);
  if (error) return a == b;
  const fs::path second = fs::weakly_canonical(b, error);
  return error ? a == b : first == second;
}

}  // namespace trace
