// The pictures that a scene names: loaded for the textures that are rendered, and told for those that are
// not.
//
// All readers share this, so that no texture vanishes without a word and a file of a hundred has one warning.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace trace {

/// Reads the pictures of the scene's textures and background, each file once, and notes them in
/// Scene::inputs. One that is missing or broken is a warning, the last, and a checker in its place; then it
/// returns false. Throws Error(Fault::limit) where memory lacks, and ReadDenied for one that may not be read
/// (base/files/read_scope.h).
bool loadTextures(Scene& scene, Messages& messages);

/// Is it that warning?
bool isOfUnreadTextures(const Message& warning);

/// The path of namedFile() (base/files/named_file.h).
std::string pictureFile(const std::string& from, const std::string& name);

/// A checker of magenta and black, which stands for a missing texture.
std::shared_ptr<const MipMap> missingPicture();

/// Pictures that a scene names and nobody will see.
class UnusedTextures {
 public:
  /// Notes one by its name as the file gives it, and the field or keyword that names it, where one picture
  /// may have several uses. The first one gives the warning its place.
  void note(std::string_view name, const SourcePlace& place, std::string_view use = {});
  bool empty() const { return names_.empty(); }

  /// Warns if there was one. `instead` says what is seen in its place.
  void report(Messages& messages, std::string_view instead = "the material's own colour") const;

  /// Warns if there was one that cannot be read, for what reason the first.
  void reportUnread(Messages& messages, std::string_view reason) const;

 private:
  /// `the textures "a", "b" and 3 more`.
  std::string list() const;

  SourcePlace place_;
  std::vector<std::string> names_;  ///< each once
  std::vector<std::string> shown_;  ///< "a.png" of refl
  std::set<std::string, std::less<>> known_;
};

}  // namespace trace
