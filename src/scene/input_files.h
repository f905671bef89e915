// The files that a scene is made of. Readers note each one that they open, and each one that the scene names
// though nobody opens it yet, such as the picture of a texture. No output may replace one of them
// (app/session/output.h), and what was read decides whether a picture is still that of its scene.
#pragma once

#include <compare>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace trace {

struct InputFile {
  std::string path;        ///< as the program opens it
  bool read = false;       ///< false: the scene only names it
  std::uint64_t hash = 0;  ///< hash of its bytes, if it was read
  bool operator==(const InputFile&) const = default;
  bool operator<(const InputFile& b) const {
    return std::tie(path, read, hash) < std::tie(b.path, b.read, b.hash);
  }
};

class InputFiles {
 public:
  void noteRead(const std::string& path, std::string_view bytes);
  void noteNamed(const std::string& path);
  /// Data of which a part of the scene with a file of its own is made.
  void note(const InputFiles& part);

  const std::vector<InputFile>& all() const { return files_; }
  /// Sixteen digits for everything that was read: the same for the same bytes. For one file alone they follow
  /// from its bytes; "" if nothing was read.
  std::string fingerprint() const;

  /// Always equal: a scene is what it holds, wherever that came from. fingerprint() tells files apart.
  bool operator==(const InputFiles&) const { return true; }

 private:
  void add(InputFile file);

  std::vector<InputFile> files_;  // in the order met
  std::set<InputFile> known_;     // the same
};

/// The bytes of namedFile(from, name) (base/files/named_file.h), noted as read, or as named if it cannot be
/// read. Throws as readBeside() of base/files/file.h.
std::string readBeside(const std::string& from, const std::string& name, InputFiles& inputs);

}  // namespace trace
