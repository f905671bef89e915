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

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace trace {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const std::string& verb, const std::string& path, const std::string& reason) {
  throw Error(Fault::io, "cannot " + verb + " \"" + path + "\": " + reason);
}

std::string temporaryName(const std::string& path) {
#if defined(__unix__) || defined(__APPLE__)
  return path + ".tmp" + std::to_string(::getpid());
#else
  return path + ".tmp";
#endif
}

/// A file opened for writing under a temporary name; removed again unless kept.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target) : target_(target), name_(temporaryName(target)) {
    std::error_code ignored;
    if (target.empty()) fail("write", target, "the name is empty");
    if (fs::is_directory(target, ignored)) fail("write", target, "it is a folder");
    file_ = std::fopen(name_.c_str(), "wb");
    if (!file_) fail("write", target, std::strerror(errno));
  }
  ~TemporaryFile() {
    if (file_) std::fclose(file_);
    if (!kept_) std::remove(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void keep(std::string_view bytes) {
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size();
    const bool flushed = std::fclose(file_) == 0;
    file_ = nullptr;
    if (!written || !flushed) fail("write", target_, std::strerror(errno));
    std::error_code error;
    fs::rename(name_, target_, error);
    if (error) fail("write", target_, error.message());
    kept_ = true;
  }

 private:
  std::string target_, name_;
  std::FILE* file_ = nullptr;
  bool kept_ = false;
};

}  // namespace

std::string readFile(const std::string& path) {
  constexpr std::size_t kMostUnknown = std::size_t{1} << 30;  // of a pipe, which may have no end
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail("read", path, "it is a folder");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail("read", path, std::strerror(errno));
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
  if (std::ferror(file.get())) fail("read", path, std::strerror(errno));
  return bytes;
}

std::string readBeside(const std::string& from, const std::string& name) {
  const std::string path = besideFile(from, name);
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    fail("read", path, "it is no ordinary file");
  return readFile(path);
}

void writeFile(const std::string& path, std::string_view bytes) { TemporaryFile(path).keep(bytes); }

void checkWritable(const std::string& path) { TemporaryFile unused(path); }

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
