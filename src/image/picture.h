// A finished picture: linear colours, row 0 at the top.
#pragma once

#include <cstddef>
#include <vector>

#include "math/color.h"

namespace trace {

struct Picture {
  int width = 0, height = 0;
  std::vector<Color> pixels;

  Picture() = default;
  Picture(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  Color& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const Color& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  bool operator==(const Picture&) const = default;
};

}  // namespace trace
