#include "app/view/screen/overlays.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "math/elementary.h"

namespace trace {
namespace {

/// The part of the line within the rectangle, from one share of its way to another.
std::optional<std::pair<Real, Real>> within(const ViewLine& line, const Vec2& low, const Vec2& size) {
  Real first = 0, last = 1;
  const auto cut = [&](Real from, Real way, Real least, Real most) {
    if (way == 0) return from >= least && from <= most;
    const Real a = (least - from) / way, b = (most - from) / way;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
    return first <= last;
  };
  if (!cut(line.from.x, line.to.x - line.from.x, low.x, low.x + size.x) ||
      !cut(line.from.y, line.to.y - line.from.y, low.y, low.y + size.y))
    return {};
  return std::pair{first, last};
}

/// How much of the lines lies below an overlay, in pixels. An end says where a ray comes from or what it
/// hits, so it counts as much as a long piece.
Real hidden(const Vec2& low, const Vec2& size, const std::vector<ViewLine>& lines) {
  constexpr Real kEnd = 80;
  Real sum = 0;
  for (const ViewLine& line : lines) {
    const auto part = within(line, low, size);
    if (!part) continue;
    const auto [first, last] = *part;
    sum += (last - first) * math::hypot(line.to.x - line.from.x, line.to.y - line.from.y);
    sum += (first == 0 ? kEnd : 0) + (last == 1 ? kEnd : 0);
  }
  return sum;
}

}  // namespace

Vec2 placeIn(ViewCorner corner, const Vec2& view, const Vec2& overlay) {
  const bool left = corner == ViewCorner::lowerLeft || corner == ViewCorner::upperLeft;
  const bool upper = corner == ViewCorner::upperLeft || corner == ViewCorner::upperRight;
  return {left ? 0 : view.x - overlay.x, upper ? 0 : view.y - overlay.y};
}

ViewCorner quietCorner(const Vec2& view, const Vec2& overlay, const std::vector<ViewLine>& lines,
                       ViewCorner now) {
  constexpr Real kClearly = 40;  // pixels
  ViewCorner best = now;
  Real least = hidden(placeIn(now, view, overlay), overlay, lines);
  if (least == 0) return now;
  least -= kClearly;
  for (const ViewCorner corner :
       {ViewCorner::lowerLeft, ViewCorner::lowerRight, ViewCorner::upperRight, ViewCorner::upperLeft})
    if (const Real sum = hidden(placeIn(corner, view, overlay), overlay, lines); sum < least) {
      least = sum;
      best = corner;
    }
  return best;
}

ScalePlace placeScale(const Vec2& area, const Vec2& picture, Real upright, Real flat) {
  if ((area.x - picture.x) / 2 >= upright) return ScalePlace::beside;
  if ((area.y - picture.y) / 2 >= flat) return ScalePlace::below;
  return ScalePlace::over;
}

}  // namespace trace
