#include "image/film/subdivision.h"

#include <algorithm>
#include <tuple>

#include "math/vec.h"

namespace trace {

bool Subdivision::differ(const Color* const (&corners)[4]) const {
  Color least(kInfinity), most(-kInfinity);
  for (const Color* c : corners) {
    if (!isFinite(*c)) continue;
    least = {std::min(least.r, c->r), std::min(least.g, c->g), std::min(least.b, c->b)};
    most = {std::max(most.r, c->r), std::max(most.g, c->g), std::max(most.b, c->b)};
  }
  const auto apart = [&](double low, double high) { return high - low > threshold * std::max(1.0, high); };
  return apart(least.r, most.r) || apart(least.g, most.g) || apart(least.b, most.b);
}

Tile Subdivision::around(int x, int y) const {
  Tile part = area;
  if (seamX > 0)
    (x < seamX ? part.x1 : part.x0) = x < seamX ? std::min(part.x1, seamX) : std::max(part.x0, seamX);
  if (seamY > 0)
    (y < seamY ? part.y1 : part.y0) = y < seamY ? std::min(part.y1, seamY) : std::max(part.y0, seamY);
  return part;
}

CornerPlace Subdivision::home(CornerPlace place) const {
  const Tile part = around(place.x, place.y);
  if (place.corner.x == side() && place.x + 1 < part.x1) {
    ++place.x;
    place.corner.x = 0;
  }
  if (place.corner.y == side() && place.y - 1 >= part.y0) {
    --place.y;
    place.corner.y = 0;
  }
  return place;
}

int Subdivision::levelOf(Corner corner) const {
  int level = depth;
  for (int both = corner.x | corner.y; level > 0 && (both & 1) == 0; both >>= 1) --level;
  return level;
}

void sortCorners(const Subdivision& rules, std::vector<Corner>& corners) {
  const auto key = [&](Corner c) { return std::tuple(rules.levelOf(c), c.y, c.x); };
  std::sort(corners.begin(), corners.end(), [&](Corner a, Corner b) { return key(a) < key(b); });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
}

}  // namespace trace
