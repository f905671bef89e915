// Height fields: z over a grid of x and y, from a picture or a formula, as bilinear or bicubic patches and
// solid down to a floor. Traced as such: a ray goes from block to block of a pyramid of least and greatest
// heights, and in each cell that is left hits the patch itself.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/field.h"
#include "geometry/shapes/surfaces/traced_heights.h"

namespace trace {

struct HeightField {
  static constexpr std::string_view kKeyword = "height_field";
  static constexpr std::string_view kHelp =
      "landscape over x and y from -1 to 1, from a picture or a formula, down to a floor";
  static constexpr int kMostPoints = 2048;

  Heights file;
  std::string formula = "0.25 * sin(3 * x) * cos(4 * y)";
  int points = 65;
  Real height = 1, floor = -0.5;
  bool smooth = false, capped = true;

  static constexpr auto fields() {
    return Fields{
        Field{"file", &HeightField::file, "", 0, 0, "a picture: brighter is higher; overrides formula"},
        Field{"formula", &HeightField::formula, "", 0, 0, "the height, of x and y"},
        Field{"points", &HeightField::points, "", 2, kMostPoints,
              "number of samples of the formula along each side"},
        Field{"height", &HeightField::height, "", -kNoLimit, kNoLimit, "factor on the heights"},
        Field{"floor", &HeightField::floor, "", -kNoLimit, kNoLimit, "z of the flat bottom"},
        Field{"smooth", &HeightField::smooth, "", 0, 1, "bicubic patches; else bilinear ones"},
        Field{"capped", &HeightField::capped, "", 0, 1,
              "solid, with sides and a bottom; else an open sheet"}};
  }
  bool operator==(const HeightField&) const = default;

  /// Throws Error if the formula cannot be read.
  std::shared_ptr<const TracedHeights> prepared() const;
};

}  // namespace trace
