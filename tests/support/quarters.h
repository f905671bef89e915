// A picture as four colours, to be compared with one that chance made otherwise.
#pragma once

#include <array>
#include <cstddef>

#include "image/picture.h"

namespace trace::test {

/// The means of the quarters of a picture, row by row. Its sides are even.
inline std::array<Color, 4> quarters(const Picture& picture) {
  std::array<Color, 4> sums;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      sums[static_cast<std::size_t>(2 * (2 * y / picture.height) + 2 * x / picture.width)] +=
          picture.at(x, y) * (4.0 / (picture.width * picture.height));
  return sums;
}

}  // namespace trace::test
