#include "scene/input_files.h"

#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/named_file.h"
#include "base/hash.h"

namespace trace {

void InputFiles::add(InputFile file) {
  if (known_.insert(file).second) files_.push_back(std::move(file));
}

void InputFiles::noteRead(const std::string& path, std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  add({path, true, hash.value()});
}

void InputFiles::noteNamed(const std::string& path) { add({path, false, 0}); }

void InputFiles::note(const InputFiles& part) {
  for (const InputFile& file : part.files_) add(file);
}

std::string InputFiles::fingerprint() const {
  std::vector<std::uint64_t> hashes;
  for (const InputFile& file : files_)
    if (file.read) hashes.push_back(file.hash);
  if (hashes.empty()) return "";
  if (hashes.size() == 1) return hexText(hashes[0]);
  Hash hash;
  for (const std::uint64_t one : hashes) hash.add(one);
  return hexText(hash.value());
}

std::string readBeside(const std::string& from, const std::string& name, InputFiles& inputs) {
  const std::string path = namedFile(from, name).path;
  try {
    std::string bytes = readBeside("", path);
    inputs.noteRead(path, bytes);
    return bytes;
  } catch (const Error&) {
    inputs.noteNamed(path);
    throw;
  }
}

}  // namespace trace
