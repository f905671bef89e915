// Reading whole files: see base/files/file.h.
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/budget.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/os/windows/api.h"

namespace trace {
namespace {

[[noreturn]] void failToRead(const std::string& path, const std::string& reason, std::string hint = {}) {
  throw Error(Fault::io, "cannot read \"" + path + "\": " + reason, std::move(hint));
}

/// False if nothing has the name.
bool factsOf(const std::string& path, struct _stat64& facts) {
  if (path.find('\0') != path.npos) return errno = EINVAL, false;  // and would be another file's
  return ::_wstat64(os::wide(path).c_str(), &facts) == 0;
}

/// A descriptor that is closed when this goes, of a file that lies on a disk.
class Opened {
 public:
  explicit Opened(const std::string& path) : path_(path) {
    struct _stat64 facts {};
    if (!factsOf(path, facts)) failToRead(path, std::strerror(errno));
    if ((facts.st_mode & S_IFMT) == S_IFDIR) failToRead(path, "it is a folder");
    if ((facts.st_mode & S_IFMT) != S_IFREG) failToRead(path, "it is a device");
    size_ = static_cast<std::uint64_t>(facts.st_size);
    file_ = ::_wopen(os::wide(path).c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT);
    if (file_ < 0) failToRead(path, std::strerror(errno));
    const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(file_));
    if (::GetFileType(handle) == FILE_TYPE_DISK) return;
    ::_close(file_);
    failToRead(path, "it is no ordinary file", "copy its contents into one");
  }
  ~Opened() { ::_close(file_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  std::uint64_t size() const { return size_; }

  /// The bytes that were read: none at the end.
  std::size_t read(char* to, std::size_t most) const {
    constexpr std::size_t kMost = std::size_t{1} << 24;
    const int count = ::_read(file_, to, static_cast<unsigned>(std::min(most, kMost)));
    if (count < 0) failToRead(path_, std::strerror(errno));
    return static_cast<std::size_t>(count);
  }

 private:
  const std::string& path_;
  std::uint64_t size_ = 0;
  int file_ = -1;
};

}  // namespace

std::string readFile(const std::string& path) {
  const Opened file(path);
  std::string bytes(file.size(), '\0');
  std::size_t read = 0;
  for (;;) {  // also what has grown since
    if (read == bytes.size()) bytes.resize(read + (std::size_t{1} << 16));
    const std::size_t count = file.read(bytes.data() + read, bytes.size() - read);
    if (count == 0) break;
    read += count;
    checkBudget();
  }
  bytes.resize(read);
  return bytes;
}

std::string readStandardInput() {
  const std::string name = "the standard input";
  std::string bytes;
  char buffer[1 << 16];
  for (;;) {
    const int count = ::_read(0, buffer, sizeof buffer);
    if (count < 0) failToRead(name, std::strerror(errno));
    if (count == 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(count));
    lookAtBudget();
  }
}

bool isOrdinaryFile(const std::string& path) {
  struct _stat64 facts {};
  return factsOf(path, facts) && (facts.st_mode & S_IFMT) == S_IFREG;
}

std::string readStart(const std::string& path, std::size_t most) {
  if (!isOrdinaryFile(path)) failToRead(path, "it is no ordinary file");
  const Opened file(path);
  std::string bytes(most, '\0');
  std::size_t read = 0;
  while (read < most) {
    const std::size_t count = file.read(bytes.data() + read, most - read);
    if (count == 0) break;
    read += count;
  }
  bytes.resize(read);
  return bytes;
}

std::string comparedName(const std::string& path) {
  std::wstring name = os::wide(path);
  ::CharUpperBuffW(name.data(), static_cast<DWORD>(name.size()));
  return os::narrow(name);
}

}  // namespace trace
