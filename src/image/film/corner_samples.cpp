#include "image/film/corner_samples.h"

#include <algorithm>

namespace trace {

const Color& CornerSamples::at(CornerPlace place, std::size_t value) const {
  place = rules_.home(place);
  const Level& level =
      levels_[tileOf(place.x, place.y)][static_cast<std::size_t>(rules_.levelOf(place.corner))];
  const std::size_t pixel = level.pixel(place.x, place.y);
  std::size_t at = level.starts[pixel];
  while (!(level.corners[at] == place.corner)) ++at;  // a handful
  return level.values[value][at];
}

std::size_t CornerSamples::countOf(int x, int y, std::size_t levels) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < levels; ++i) {
    const Level& level = levels_[tileOf(x, y)][i];
    if (!level.has(x, y)) continue;
    const std::size_t pixel = level.pixel(x, y);
    count += level.starts[pixel + 1] - level.starts[pixel];
  }
  return count;
}

std::vector<Corner> CornerSamples::wanted(int x, int y, int level) const {
  std::vector<Corner> corners;
  const auto add = [&](int ofX, int ofY, int cx, int cy) {
    const Corner corner{static_cast<std::uint8_t>(cx), static_cast<std::uint8_t>(cy)};
    const CornerPlace home = rules_.home({ofX, ofY, corner});
    if (home.x == x && home.y == y) corners.push_back(home.corner);
  };
  if (level == 0) {
    for (const int cy : {0, rules_.side()})
      for (const int cx : {0, rules_.side()}) add(x, y, cx, cy);
    return corners;
  }
  const Tile part = rules_.around(x, y);
  const auto look = [&](int ofX, int ofY) {  // at the squares that fall apart at this level
    if (ofX < part.x0 || ofX >= part.x1 || ofY < part.y0 || ofY >= part.y1) return;
    divide(
        rules_, level, of(ofX, ofY), [](int, int, int) {},
        [&](int sx, int sy, int size, int at) {
          if (at != level - 1) return;
          const int half = size / 2;
          add(ofX, ofY, sx + half, sy + half);
          add(ofX, ofY, sx, sy + half);
          add(ofX, ofY, sx + half, sy);
          add(ofX, ofY, sx + size, sy + half);
          add(ofX, ofY, sx + half, sy + size);
        });
  };
  look(x, y);
  look(x - 1, y);  // whose right edge is the left one here
  look(x, y + 1);  // whose upper edge is the lower one here
  sortCorners(rules_, corners);
  return corners;
}

CornerPlace CornerSamples::userOf(CornerPlace home) const {
  const int level = rules_.levelOf(home.corner);
  const auto side = static_cast<std::uint8_t>(rules_.side());
  const CornerPlace places[] = {
      home, {home.x - 1, home.y, {side, home.corner.y}}, {home.x, home.y + 1, {home.corner.x, side}}};
  const Tile part = rules_.around(home.x, home.y);
  for (const CornerPlace& place : places) {
    if (place.x < part.x0 || place.y >= part.y1 || !(rules_.home(place) == home)) continue;
    const auto corners = cornersOf(rules_, level, of(place.x, place.y));
    if (std::find(corners.begin(), corners.end(), place.corner) != corners.end()) return place;
  }
  return home;
}

}  // namespace trace
