// The pixel whose rays a person wants to see: a place in the picture, which stays when the picture's size
// changes.
#pragma once

#include <cmath>
#include <optional>

#include "render/samples/picture_size.h"

namespace trace {

class PixelChoice {
 public:
  /// The pixel (x, y) of a picture of this size.
  void choose(int x, int y, Size of) { chosen_ = Chosen{{x, y}, of}; }
  void clear() { chosen_.reset(); }
  explicit operator bool() const { return chosen_.has_value(); }

  /// The pixel at that place of a picture of this size. Precondition: one was chosen.
  PixelPlace in(Size size) const {
    const auto [pixel, of] = *chosen_;
    return {scaled(pixel.x, of.width, size.width), scaled(pixel.y, of.height, size.height)};
  }

 private:
  struct Chosen {
    PixelPlace pixel;
    Size of;
  };

  /// The pixel that holds the middle of what was pixel `x` of `before`.
  static int scaled(int x, int before, int now) {
    if (before <= 0 || before == now) return x;
    return static_cast<int>(std::floor((x + 0.5) * now / before));
  }

  std::optional<Chosen> chosen_;
};

}  // namespace trace
