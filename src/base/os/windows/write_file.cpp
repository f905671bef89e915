// Writing whole files: see base/files/file.h.
//
// A file is written beside its place, reaches the disk, and then takes the place in one step, while it is
// open: nobody else can open or remove it before. One that can be removed was left by a process that died.
#include <cstring>
#include <filesystem>
#include <vector>

#include "base/budget.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/os/temporary_name.h"
#include "base/os/windows/api.h"

namespace trace {
namespace {

namespace fs = std::filesystem;
using os::Handle;
using os::wide;

[[noreturn]] void failToWrite(const std::string& path, const std::string& reason) {
  throw Error(Fault::io, "cannot write \"" + path + "\": " + reason);
}
[[noreturn]] void failToWriteFor(const std::string& path, DWORD error) {
  failToWrite(path, os::reasonOf(error));
}

std::string folderOf(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().generic_string();
  return folder.empty() ? "." : folder;
}

HANDLE openToWrite(const std::string& path, DWORD how) {
  return ::CreateFileW(wide(path).c_str(), GENERIC_WRITE | DELETE, 0, nullptr, how, FILE_ATTRIBUTE_NORMAL,
                       nullptr);
}

/// A device or a pipe: it takes the bytes as they come.
bool isDevice(const std::string& path) {
  const Handle file(::CreateFileW(wide(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                                  OPEN_EXISTING, 0, nullptr));
  return file && ::GetFileType(file.get()) != FILE_TYPE_DISK;
}

/// Throws unless something may be written there.
void checkTarget(const std::string& path) {
  if (path.empty()) failToWrite(path, "the name is empty");
  if (path.find('\0') != path.npos) failToWrite(path, "the name holds a zero");
  const DWORD is = ::GetFileAttributesW(wide(path).c_str());
  if (is != INVALID_FILE_ATTRIBUTES) {
    if (is & FILE_ATTRIBUTE_DIRECTORY) failToWrite(path, "it is a folder");
    if (is & FILE_ATTRIBUTE_READONLY) failToWrite(path, "it is read-only");
    return;
  }
  const DWORD folder = ::GetFileAttributesW(wide(folderOf(path)).c_str());
  if (folder == INVALID_FILE_ATTRIBUTES) failToWriteFor(path, ERROR_PATH_NOT_FOUND);
  if (!(folder & FILE_ATTRIBUTE_DIRECTORY)) failToWriteFor(path, ERROR_DIRECTORY);
}

void writeAll(const Handle& file, const std::string& path, std::string_view bytes) {
  constexpr std::size_t kMost = std::size_t{1} << 24;
  while (!bytes.empty()) {
    DWORD written = 0;
    if (!::WriteFile(file.get(), bytes.data(), static_cast<DWORD>(std::min(bytes.size(), kMost)), &written,
                     nullptr))
      failToWriteFor(path, ::GetLastError());
    bytes.remove_prefix(written);
  }
}

/// A new file in the folder of its place.
class Temporary {
 public:
  explicit Temporary(const std::string& path)
      : path_(path), file_(openToWrite(os::temporaryName(folderOf(path)), CREATE_NEW)) {
    if (!file_) failToWriteFor(path, ::GetLastError());
  }
  ~Temporary() {
    if (inPlace_ || !file_) return;
    FILE_DISPOSITION_INFO gone{TRUE};
    ::SetFileInformationByHandle(file_.get(), FileDispositionInfo, &gone, sizeof gone);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(std::string_view bytes) const {
    writeAll(file_, path_, bytes);
    ::FlushFileBuffers(file_.get());
  }

  /// Programs that look at every new file, as those against viruses do, may hold the place for a moment.
  void takePlace() {
    constexpr int kTries = 20;
    constexpr DWORD kPause = 50;  // milliseconds
    for (int i = 0; i < kTries && !inPlace_; ++i) {
      if (i > 0) ::Sleep(kPause);
      inPlace_ = rename();
      const DWORD error = inPlace_ ? ERROR_SUCCESS : ::GetLastError();
      const bool mayPass = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED;
      if (!inPlace_ && (!mayPass || i + 1 == kTries)) failToWriteFor(path_, error);
    }
  }

 private:
  bool rename() const {
    const std::wstring to = wide(fs::absolute(path_).make_preferred().generic_string());
    const std::size_t bytes = to.size() * sizeof(wchar_t);
    std::vector<char> memory(sizeof(FILE_RENAME_INFO) + bytes);
    auto* const info = reinterpret_cast<FILE_RENAME_INFO*>(memory.data());
    info->ReplaceIfExists = TRUE;
    info->FileNameLength = static_cast<DWORD>(bytes);
    std::memcpy(info->FileName, to.data(), bytes);
    return ::SetFileInformationByHandle(file_.get(), FileRenameInfo, info, static_cast<DWORD>(memory.size()));
  }

  const std::string& path_;
  const Handle file_;
  bool inPlace_ = false;
};

/// Removes what processes that died have left in the folder: what a living one writes cannot be removed.
void removeLeftovers(const std::string& folder) {
  std::error_code error;
  for (fs::directory_iterator i(folder, error); !error && i != fs::directory_iterator(); i.increment(error))
    if (os::isTemporaryName(i->path().filename().generic_string())) ::DeleteFileW(i->path().c_str());
}

}  // namespace

void writeFile(const std::string& path, std::string_view bytes) {
  checkTarget(path);
  if (isDevice(path)) {
    const Handle device(openToWrite(path, OPEN_EXISTING));
    if (!device) failToWriteFor(path, ::GetLastError());
    return writeAll(device, path, bytes);
  }
  Temporary file(path);
  file.write(bytes);
  file.takePlace();
}

void checkWritable(const std::string& path) {
  checkTarget(path);
  if (isDevice(path)) return;
  removeLeftovers(folderOf(path));
  const Temporary unused(path);
}

std::string makeOwnFolder() {
  std::error_code error;
  const fs::path around = fs::temp_directory_path(error);
  if (error) throw Error(Fault::io, "there is no folder for temporary files: " + error.message());
  const std::string path = os::temporaryName(around.generic_string());
  if (!::CreateDirectoryW(wide(path).c_str(), nullptr)) failToWriteFor(path, ::GetLastError());
  return path;
}

}  // namespace trace
