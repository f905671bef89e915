// The pixels of a picture that a scene names.
#pragma once

#include <memory>
#include <string>

#include "base/error.h"
#include "image/maps/mipmap.h"

namespace trace {

/// A picture file that lies inside the file of a scene.
struct InsideFile {
  std::string name;   ///< that the scene's file gives it; may be empty
  std::string bytes;  ///< bytes of the picture file
};

/// The pixels of a file, behind a shared const handle; null until they are loaded (formats/textures.h).
struct Pixels {
  std::string file;                   ///< as the scene names it
  std::shared_ptr<const MipMap> map;  ///< follows from the file
  SourcePlace place;                  ///< where the scene names it
  /// Null for a file of its own, and where the one inside cannot be read.
  std::shared_ptr<const InsideFile> inside{};
  bool operator==(const Pixels& other) const { return file == other.file; }
};

}  // namespace trace
