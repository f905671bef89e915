// The numbers of a picture as its file has them: 8 or 16 bits or floats, with transparency.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "image/picture.h"

namespace trace {

struct Raster {
  using Samples = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>>;

  int width = 0, height = 0;
  int channels = 3;            ///< 1: grey; 2: grey, alpha; 3: red, green, blue; 4: these and alpha
  double most = 1;             ///< the sample that stands for 1
  bool premultiplied = false;  ///< colours are multiplied by alpha already
  Samples samples{};           ///< row 0 at the top, the channels of a pixel side by side

  Raster() = default;
  Raster(int w, int h, int c, double m) : width(w), height(h), channels(c), most(m) {}
  bool hasAlpha() const { return channels % 2 == 0; }
  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(channels);
  }
};

/// Its colours; transparency is dropped.
Picture toPicture(const Raster& raster);

}  // namespace trace
