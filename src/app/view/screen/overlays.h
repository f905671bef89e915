// Where legends and scales lie over a view, so that they hide as little of it as possible.
#pragma once

#include <vector>

#include "math/vec.h"

namespace trace {

/// A line of a view, in pixels from its upper left corner.
struct ViewLine {
  Vec2 from, to;
};

enum class ViewCorner { lowerLeft, lowerRight, upperRight, upperLeft };
constexpr bool isUpper(ViewCorner corner) {
  return corner == ViewCorner::upperRight || corner == ViewCorner::upperLeft;
}

/// The upper left corner of an overlay of that size in a corner of the view.
Vec2 placeIn(ViewCorner corner, const Vec2& view, const Vec2& overlay);

/// The corner in which an overlay hides the least of the lines and of their ends. It is `now` unless another
/// corner is clearly better, so that the overlay does not jump.
ViewCorner quietCorner(const Vec2& view, const Vec2& overlay, const std::vector<ViewLine>& lines,
                       ViewCorner now);

/// Where the scale of a heat map lies.
enum class ScalePlace {
  beside,  ///< upright, to the right of the picture
  below,   ///< flat, below the picture
  over     ///< neither has room: the picture has to become smaller, or to be hidden in part
};

/// For a picture in the middle of an area. `upright`: width of the upright scale, `flat`: height of the flat
/// one.
ScalePlace placeScale(const Vec2& area, const Vec2& picture, Real upright, Real flat);

}  // namespace trace
