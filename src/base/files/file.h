// Whole files in and out. A written file appears complete under its name or not at all.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trace {

/// The bytes of the file, or of a pipe until its end. Throws Error(Fault::io) with the reason when it cannot
/// be read, as a folder, a device, a file that the kernel makes up (/proc), or a pipe that no program writes
/// into for some seconds. Waits for a pipe's writer as long as the budget of the thread lets it.
std::string readFile(const std::string& path);

/// The bytes that come in on the standard input until its end. Throws as readFile().
std::string readStandardInput();

/// The name of the standard input where a command reads a scene or a picture.
inline constexpr std::string_view kStandardInput = "-";

/// The bytes of the file, or of the standard input for its name.
inline std::string readInput(const std::string& path) {
  return path == kStandardInput ? readStandardInput() : readFile(path);
}

/// At most so many bytes from its start. Throws Error(Fault::io) also for a pipe.
std::string readStart(const std::string& path, std::size_t most);

/// Leads the name to a file that is there, and is no folder, device, pipe or socket?
bool isOrdinaryFile(const std::string& path);

/// The bytes of a file that the file `from` names: besideFile(from, name). Throws as readFile(), for what is
/// no regular file, which may have no end, and ReadDenied for what may not be read (base/files/read_scope.h).
std::string readBeside(const std::string& from, const std::string& name);

/// Writes beside `path`, then puts the file in its place, so that nobody ever sees a part of it. A file that
/// is there is replaced: mode and owner stay, and so do links, which lead to the new one. Throws
/// Error(Fault::io), also for a file that is read-only; `path` is then untouched.
void writeFile(const std::string& path, std::string_view bytes);

/// Throws Error(Fault::io) unless a file could be written at `path` now. Leaves nothing behind, and removes
/// from the folder what processes that died while writing have left there.
void checkWritable(const std::string& path);

/// Are both names of one file? Links and other spellings count; a file that does not exist is known by its
/// path.
bool sameFile(const std::string& a, const std::string& b);

/// The name as all its spellings in letters of either case are compared: on Windows in capitals, since they
/// name one file there; elsewhere as it is.
std::string comparedName(const std::string& path);

/// A new folder among the system's temporary files, which nobody could guess and nobody else may enter.
/// Throws Error(Fault::io).
std::string makeOwnFolder();

/// May a file have the name? On Windows names are UTF-8.
bool mayNameFile(const std::string& name);

/// `name` as seen from the file `from`: unchanged if absolute, else inside the folder of `from`. Throws
/// Error(Fault::io) if no file may have the name.
std::string besideFile(const std::string& from, const std::string& name);

/// `path` as a file in `folder` names it, both absolute and without "..": by the way from there, or as it is
/// where no way leads to it, as between the drives of Windows.
std::string nameFrom(const std::string& folder, const std::string& path);

}  // namespace trace
