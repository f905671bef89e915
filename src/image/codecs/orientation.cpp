#include "image/codecs/orientation.h"

#include <algorithm>
#include <utility>

#include "base/match.h"

namespace trace {

Raster oriented(Raster raster, Orientation orientation) {
  if (orientation == Orientation::upright) return raster;
  const int number = static_cast<int>(orientation), w = raster.width, h = raster.height;
  const bool turns = number >= 5;
  // For the place (x, y) in the picture: which column and row of the file.
  const bool fromRight = number == 2 || number == 3 || number == 7 || number == 8;
  const bool fromBottom = number == 3 || number == 4 || number == 6 || number == 7;
  Raster result = raster;
  if (turns) std::swap(result.width, result.height);
  const auto channels = static_cast<std::size_t>(raster.channels);
  match(raster.samples, [&](const auto& from) {
    auto& to = std::get<std::decay_t<decltype(from)>>(result.samples);
    std::size_t next = 0;
    for (int y = 0; y < result.height; ++y)
      for (int x = 0; x < result.width; ++x, next += channels) {
        const int along = turns ? y : x, across = turns ? x : y;
        const int column = fromRight ? w - 1 - along : along, row = fromBottom ? h - 1 - across : across;
        const std::size_t at =
            (static_cast<std::size_t>(row) * static_cast<std::size_t>(w) + static_cast<std::size_t>(column)) *
            channels;
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(at), channels,
                    to.begin() + static_cast<std::ptrdiff_t>(next));
      }
  });
  return result;
}

}  // namespace trace
