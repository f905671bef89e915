// An EXR file to be written: any channels, which may make layers, and a part of the picture (exr_file.cpp).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/codecs/metadata.h"
#include "image/film/film.h"
#include "image/picture.h"

namespace trace {

/// Keeps our words apart from the attributes that OpenEXR gives a meaning.
inline constexpr std::string_view kExrWordPrefix = "trace:";

struct ExrChannel {
  std::string name;           ///< "R", or "LAYER.R"
  std::vector<float> values;  ///< values of the window, row by row
};

struct ExrFile {
  int width = 0, height = 0;  ///< size of the display window: the whole picture
  Tile window{0, 0, 0, 0};    ///< the data window: the part that is stored
  std::vector<ExrChannel> channels{};
  Metadata words{};       ///< how the picture was made
  Metadata attributes{};  ///< text attributes of any name
};

/// The bytes of the file. Throws what OpenEXR throws.
std::string encodeExr(const ExrFile& file);

/// Adds the red, green and blue of a picture of the whole size, as many as there are names.
void addChannels(ExrFile& file, const Picture& picture, std::span<const std::string> names);

}  // namespace trace
