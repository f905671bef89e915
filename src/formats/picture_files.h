// The pictures of a scene as a file that is written names them: where they are, as seen from there, or, if
// they lie inside the scene's own file, as files beside it.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "formats/format.h"

namespace trace {

struct SeenFrom {
  Scene scene;
  /// The pictures of used materials and of the background that lay inside, in the order met. The scene names
  /// them.
  std::vector<NamedBytes> pictures;
};

/// The scene with the names of its pictures as `file` finds them, which may lie in another folder. A picture
/// "wheel" from inside becomes FILE-wheel.png beside FILE.ray, in the format that it has. Another number
/// stands behind the name if something else lies there: a file that is none of the same bytes, and that the
/// file which is replaced does not name. Warns of pictures that have no place, as nothing is beside a pipe.
SeenFrom seenFrom(const Scene& scene, const std::string& file, Messages& messages);

/// The pictures that a file which cannot hold all textures does name.
std::vector<NamedBytes> picturesNamed(const std::set<std::string>& names, const SeenFrom& seen);

}  // namespace trace
