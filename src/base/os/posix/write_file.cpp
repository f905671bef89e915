// Writing whole files: see file.h.
//
// A file is written beside its place, reaches the disk, and then takes the place in one step. While it is
// written it has no name, so that it vanishes with the process, however that ends. Where the file system has
// no such files it is called `.trace-` and sixteen random digits, and is locked: one that nobody has locked
// was left by a process that died, and the next run removes it. The place is the one behind all links.
#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/os/linux.h"
#include "base/os/temporary_name.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

constexpr int kTries = 100;

[[noreturn]] void failToWrite(const std::string& path, const std::string& reason) {
  throw Error(Fault::io, "cannot write \"" + path + "\": " + reason);
}
[[noreturn]] void failToWriteFor(const std::string& path, int error) {
  failToWrite(path, std::strerror(error));
}

/// A descriptor that is closed when this goes.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

/// The file to be overwritten, or the place of a new one.
struct Target {
  std::string name;      ///< as asked for, for messages
  std::string path;      ///< behind all links
  std::string folder;    ///< folder of the path
  bool ordinary = true;  ///< false: a device or a pipe, which takes the bytes as they come
  bool exists = false;
  struct stat was {};  ///< if it exists
};

/// Throws unless something may be written there.
Target targetOf(const std::string& name) {
  constexpr int kMostLinks = 40;
  if (name.empty()) failToWrite(name, "the name is empty");
  if (name.find('\0') != name.npos) failToWrite(name, "the name holds a zero");
  Target target;
  target.name = name;
  fs::path path = name;
  for (int links = 0;; ++links) {
    if (::lstat(path.c_str(), &target.was) != 0) {
      if (errno != ENOENT) failToWriteFor(name, errno);
      break;
    }
    if (!S_ISLNK(target.was.st_mode)) {
      target.exists = true;
      break;
    }
    if (links >= kMostLinks) failToWriteFor(name, ELOOP);
    // A link of the system, as /dev/stdout, leads to what has no path of its own.
    struct stat behind {};
    if (::stat(path.c_str(), &behind) == 0 && !S_ISREG(behind.st_mode) && !S_ISDIR(behind.st_mode)) {
      target.was = behind;
      target.exists = true;
      break;
    }
    std::error_code error;
    const fs::path next = fs::read_symlink(path, error);
    if (error) failToWrite(name, error.message());
    path = path.parent_path() / next;
  }
  target.path = path.string();
  target.folder = path.has_parent_path() ? path.parent_path().string() : ".";
  if (!target.exists) return target;
  if (S_ISDIR(target.was.st_mode)) failToWrite(name, "it is a folder");
  target.ordinary = S_ISREG(target.was.st_mode);
  constexpr mode_t kAnyoneWrites = S_IWUSR | S_IWGRP | S_IWOTH;  // what root may do anyway is not meant
  const bool readOnly = (target.was.st_mode & kAnyoneWrites) == 0;
  if (readOnly || ::faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0)
    failToWrite(name, "it is read-only");
  return target;
}

/// Takes the lock that says: a process is writing this. False if another one has it.
bool lock(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }

/// Removes what processes that died have left in the folder. The process that holds the lock of a file is
/// alive.
void removeLeftovers(const std::string& folder) {
  DIR* const all = ::opendir(folder.c_str());
  if (!all) return;
  while (const dirent* entry = ::readdir(all)) {
    if (!os::isTemporaryName(entry->d_name)) continue;
    const std::string path = (fs::path(folder) / entry->d_name).string();
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat facts {};
    const bool own =
        file && ::fstat(file.get(), &facts) == 0 && S_ISREG(facts.st_mode) && facts.st_uid == ::geteuid();
    if (own && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
  }
  ::closedir(all);
}

/// A new file in the folder of its place.
class Temporary {
 public:
  enum class Name { ifNeeded, always };

  Temporary(const Target& target, [[maybe_unused]] Name name) : target_(target) {
    const mode_t mode = target.exists ? target.was.st_mode & 0777 : 0666;
#if defined(TRACE_OS_LINUX) && defined(O_TMPFILE)
    if (name == Name::ifNeeded)
      file_ = Descriptor(::open(target.folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode));
#endif
    if (file_)
      lock(file_.get());
    else
      openNamed(mode);
  }
  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) failToWriteFor(target_.name, errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  /// Owner and mode are those of the file that was there. The bytes are on the disk before the name is.
  void finish() {
    if (target_.exists) {
      // Only root may give a file away; for others it stays their own.
      if (::fchown(file_.get(), target_.was.st_uid, target_.was.st_gid) != 0) errno = 0;
      if (::fchmod(file_.get(), target_.was.st_mode & 0777) != 0) failToWriteFor(target_.name, errno);
    }
    const bool unable = ::fsync(file_.get()) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP;
    if (unable) failToWriteFor(target_.name, errno);
  }

  /// False if the file can have no name here, so that one with a name has to be written.
  bool takePlace() {
    if (name_.empty()) {
      if (!target_.exists && linkAs(target_.path)) {
        sync();
        return true;
      }
      for (int i = 0; i < kTries && name_.empty(); ++i)
        if (const std::string name = os::temporaryName(target_.folder); linkAs(name))
          name_ = name;
        else if (errno != EEXIST)
          return false;
      if (name_.empty()) return false;
    }
    if (::rename(name_.c_str(), target_.path.c_str()) != 0) failToWriteFor(target_.name, errno);
    name_.clear();
    sync();
    return true;
  }

 private:
  void openNamed(mode_t mode) {
    for (int i = 0; i < kTries; ++i) {
      const std::string name = os::temporaryName(target_.folder);
      file_ = Descriptor(::open(name.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, mode));
      if (!file_ && errno == EEXIST) continue;
      if (!file_) failToWriteFor(target_.name, errno);
      // Until it is locked another process may take it for a leftover.
      struct stat facts {};
      if (!lock(file_.get()) || ::fstat(file_.get(), &facts) != 0 || facts.st_nlink == 0) continue;
      name_ = name;
      return;
    }
    failToWriteFor(target_.name, EEXIST);
  }

  bool linkAs(const std::string& name) const {
    const std::string self = "/proc/self/fd/" + std::to_string(file_.get());
    return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  }

  /// The name is on the disk too. Not every file system can say so; the file is in its place all the same.
  void sync() const {
    const Descriptor folder(::open(target_.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder) ::fsync(folder.get());
  }

  const Target& target_;
  Descriptor file_;
  std::string name_;  // "" while it has none
};

/// Into a device or a pipe, whose reader has to be there and may take its time.
void writeInto(const Target& target, std::string_view bytes) {
  constexpr int kLook = 50, kPatience = 5000;  // milliseconds
  const auto opened = [&] {
    return ::open(target.path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  };
  Descriptor file(opened());
  for (int waited = 0; !file && errno == ENXIO && S_ISFIFO(target.was.st_mode); waited += kLook) {
    if (waited >= kPatience) failToWrite(target.name, "it is a pipe, and no program has opened it to read");
    lookAtBudget();
    ::poll(nullptr, 0, kLook);
    file = Descriptor(opened());
  }
  if (!file) failToWriteFor(target.name, errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd ready{file.get(), POLLOUT, 0};
      ::poll(&ready, 1, kLook);
      lookAtBudget();
    } else if (errno != EINTR) {
      failToWriteFor(target.name, errno);
    }
  }
}

}  // namespace

void writeFile(const std::string& path, std::string_view bytes) {
  const Target target = targetOf(path);
  if (!target.ordinary) return writeInto(target, bytes);
  for (const auto name : {Temporary::Name::ifNeeded, Temporary::Name::always}) {
    Temporary file(target, name);
    file.write(bytes);
    file.finish();
    if (file.takePlace()) return;
  }
  failToWrite(path, "a new file gets no name");
}

void checkWritable(const std::string& path) {
  const Target target = targetOf(path);
  if (!target.ordinary) return;
  removeLeftovers(target.folder);
  const Temporary unused(target, Temporary::Name::ifNeeded);
}

std::string makeOwnFolder() {
  std::error_code error;
  const fs::path around = fs::temp_directory_path(error);
  if (error) throw Error(Fault::io, "there is no folder for temporary files: " + error.message());
  std::string path = (around / "trace-XXXXXX").string();
  if (!::mkdtemp(path.data())) failToWrite(path, std::strerror(errno));
  return path;
}

}  // namespace trace
