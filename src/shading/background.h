// What camera rays see that meet nothing: flat bands of colour across the picture. Mirrored and refracted
// rays that meet nothing see black.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace {

struct Background {
  static constexpr std::string_view kKeyword = "background";
  static constexpr std::string_view kHelp =
      "bands of colour behind everything, from the top of the picture down";

  std::vector<Color> colors;  ///< from the top downward; none: black
  /// Where each band but the last ends, as a share of the picture's height from the top, ascending; none: all
  /// bands are equally high.
  std::vector<Real> limits;

  static constexpr auto fields() {
    return std::tuple{
        Field{"colors", &Background::colors, "", 0, kNoLimit, "of the bands, from the top; none is black"},
        Field{"limits", &Background::limits, "", 0, 1,
              "where each band but the last ends, a share of the height from the top; none: equal bands"}};
  }
  bool operator==(const Background&) const = default;

  /// At a share of the picture's height from the top.
  Color at(Real fromTop) const {
    if (colors.empty()) return Color(0);
    const auto last = static_cast<Real>(colors.size() - 1);
    const Real band =
        limits.empty()
            ? fromTop * (last + 1)
            : static_cast<Real>(std::upper_bound(limits.begin(), limits.end(), fromTop) - limits.begin());
    return colors[static_cast<std::size_t>(band > 0 ? std::min(band, last) : 0)];
  }
};

}  // namespace trace
