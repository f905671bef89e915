// Reading whole files: see file.h.
//
// A name may lead to something that has no end or never answers: a device, a pipe that nobody fills, a file
// of the kernel such as /proc/kmsg, which claims to be an ordinary one. So nothing here waits without looking
// at the budget of the thread, and what cannot be a file of a user is refused before it is opened.
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/os/linux.h"

#if defined(TRACE_OS_LINUX)
#include <sys/vfs.h>
#endif

namespace trace {
namespace {

[[noreturn]] void failToRead(const std::string& path, const std::string& reason, std::string hint = {}) {
  throw Error(Fault::io, "cannot read \"" + path + "\": " + reason, std::move(hint));
}

/// A file that the kernel makes up while it is read: those of /proc, /sys and the like.
bool isMadeByTheKernel([[maybe_unused]] int file) {
#if defined(TRACE_OS_LINUX)
  constexpr unsigned long kKinds[] = {0x9fa0,       // /proc
                                      0x62656572,   // /sys
                                      0x64626720,   // debugfs
                                      0x74726163,   // tracefs
                                      0x73636673,   // securityfs
                                      0x6e736673};  // namespaces
  struct statfs facts {};
  if (::fstatfs(file, &facts) != 0) return false;
  for (const unsigned long kind : kKinds)
    if (static_cast<unsigned long>(facts.f_type) == kind) return true;
#endif
  return false;
}

/// A descriptor that is closed when this goes.
class Opened {
 public:
  /// Does not wait for somebody at the other end of a pipe.
  explicit Opened(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (file_ < 0) failToRead(path, std::strerror(errno));
  }
  ~Opened() { ::close(file_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  int get() const { return file_; }

 private:
  int file_;
};

struct stat factsOf(const Opened& file, const std::string& path) {
  struct stat facts {};
  if (::fstat(file.get(), &facts) != 0) failToRead(path, std::strerror(errno));
  return facts;
}

/// Throws for what is neither an ordinary file nor a pipe. Before it is opened, which may do something to a
/// device.
void checkKind(const std::string& path) {
  if (path.find('\0') != path.npos) failToRead(path, "the name holds a zero");  // and would be another file's
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) failToRead(path, std::strerror(errno));
  if (S_ISDIR(facts.st_mode)) failToRead(path, "it is a folder");
  if (S_ISREG(facts.st_mode) || S_ISFIFO(facts.st_mode)) return;
  failToRead(path, S_ISSOCK(facts.st_mode) ? "it is a socket" : "it is a device",
             "a file or a pipe is read, as in ray <(command) out.png");
}

/// The bytes that can be had now: none at the end, nothing where they are yet to come.
std::optional<std::size_t> readSome(const Opened& file, char* to, std::size_t most, const std::string& path) {
  for (;;) {
    const ssize_t count = ::read(file.get(), to, most);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno == EAGAIN || errno == EWOULDBLOCK) return {};
    if (errno != EINTR) failToRead(path, std::strerror(errno));
  }
}

/// A pipe, whose writer may take its time, but has to be there.
std::string readPipe(const Opened& file, const std::string& path) {
  constexpr std::size_t kMost = std::size_t{1} << 30;  // it may have no end
  constexpr int kLook = 50, kPatience = 5000;          // milliseconds
  std::string bytes;
  char buffer[1 << 16];
  for (int waited = 0;;) {
    lookAtBudget();
    const auto count = readSome(file, buffer, sizeof buffer, path);
    if (count && *count > 0) {
      bytes.append(buffer, *count);
      if (bytes.size() > kMost)
        throw Error(Fault::limit,
                    "cannot read \"" + path + "\": it goes on after " + std::to_string(kMost >> 20) + " MiB");
      continue;
    }
    pollfd ready{file.get(), POLLIN, 0};
    ::poll(&ready, 1, kLook);
    if (!count || (ready.revents & POLLIN)) continue;  // somebody is there and will write
    if (!bytes.empty() || (ready.revents & POLLHUP)) return bytes;
    if ((waited += kLook) >= kPatience)
      failToRead(path, "it is a pipe, and no program has opened it to write");
  }
}

}  // namespace

std::string readFile(const std::string& path) {
  checkKind(path);
  const Opened file(path);
  const struct stat facts = factsOf(file, path);
  if (S_ISFIFO(facts.st_mode)) return readPipe(file, path);
  if (!S_ISREG(facts.st_mode) || isMadeByTheKernel(file.get()))
    failToRead(path, "it is no ordinary file", "copy its contents into one");
  std::string bytes(static_cast<std::size_t>(facts.st_size) + 1, '\0');  // one more, so that its end is seen
  std::size_t read = 0;
  for (;;) {  // also what has grown since
    if (read == bytes.size()) bytes.resize(read + (std::size_t{1} << 16));
    const std::size_t most = std::min(bytes.size() - read, std::size_t{1} << 24);
    const auto count = readSome(file, bytes.data() + read, most, path);
    if (!count) failToRead(path, "it is no ordinary file");
    if (*count == 0) break;
    read += *count;
    checkBudget();
  }
  bytes.resize(read);
  return bytes;
}

std::string readStandardInput() { return readFile("/dev/stdin"); }

bool isOrdinaryFile(const std::string& path) {
  struct stat facts {};
  return path.find('\0') == path.npos && ::stat(path.c_str(), &facts) == 0 && S_ISREG(facts.st_mode);
}

std::string readStart(const std::string& path, std::size_t most) {
  if (!isOrdinaryFile(path)) failToRead(path, "it is no ordinary file");
  const Opened file(path);
  if (!S_ISREG(factsOf(file, path).st_mode) || isMadeByTheKernel(file.get()))
    failToRead(path, "it is no ordinary file");
  std::string bytes(most, '\0');
  std::size_t read = 0;
  while (read < most) {
    const auto count = readSome(file, bytes.data() + read, most - read, path);
    if (!count || *count == 0) break;
    read += *count;
  }
  bytes.resize(read);
  return bytes;
}

std::string comparedName(const std::string& path) { return path; }

}  // namespace trace
