// Names of pictures, of which some choose a layer: "render.exr:diffuse".
#pragma once

#include <string>
#include <string_view>

namespace trace {

struct PictureName {
  std::string file;
  std::string layer;  ///< what is behind the colon after ".exr"; "" for the picture of the file

  /// As it was written, of another file.
  std::string of(const std::string& other) const { return layer.empty() ? other : other + ":" + layer; }
};

PictureName pictureName(const std::string& name);

}  // namespace trace
