#include "base/file.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/budget.h"
#include "base/error.h"
#include "base/read_scope.h"

namespace trace {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void failToRead(const std::string& path, const std::string& reason) {
  throw Error(Fault::io, "cannot read \"" + path + "\": " + reason);
}

}  // namespace

std::string readFile(const std::string& path) {
  constexpr std::size_t kMostUnknown = std::size_t{1} << 30;  // of a pipe, which may have no end
  if (path.find('\0') != path.npos) failToRead(path, "the name holds a zero");  // and would be another file's
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) failToRead(path, "it is a folder");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) failToRead(path, std::strerror(errno));
  // A file of known size in one go; a pipe, or what has grown since, piece by piece.
  std::error_code unknown;
  const std::uintmax_t size = fs::file_size(path, unknown);
  std::string bytes(unknown ? 0 : static_cast<size_t>(size), '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  char buffer[1 << 16];
  const std::size_t most = bytes.size() + kMostUnknown;
  for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) {
    checkBudget();
    if (bytes.size() + n > most)
      throw Error(Fault::limit, "cannot read \"" + path + "\": it goes on after " +
                                    std::to_string(bytes.size() >> 20) + " MiB");
    bytes.append(buffer, n);
  }
  if (std::ferror(file.get())) failToRead(path, std::strerror(errno));
  return bytes;
}

std::string readBeside(const std::string& from, const std::string& name) {
  const std::string path = besideFile(from, name);
  checkMayRead(path);
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    failToRead(path, "it is no ordinary file");
  return readFile(path);
}

std::string besideFile(const std::string& from, const std::string& name) {
  const fs::path path(name);
  return path.is_absolute() ? name : (fs::path(from).parent_path() / path).string();
}

}  // namespace trace
