// A lens opening of any shape: a picture, whose places let through light by their brightness.
#pragma once

#include <cstddef>
#include <vector>

#include "image/picture.h"
#include "math/vec.h"

namespace trace {

class Aperture {
 public:
  /// A picture that is black everywhere is open everywhere.
  explicit Aperture(const Picture& picture);

  /// Where two numbers from 0 up to 1 lie, by the brightness; the longer side of the picture goes from -1 to
  /// 1, upward as its rows go from the last to the first.
  Vec2 at(const Vec2& u) const;

 private:
  int width_, height_;
  std::vector<Real> sums_;     ///< in each row, of the places up to and with each
  std::vector<Real> rowSums_;  ///< row sums of the rows up to and with each
};

}  // namespace trace
