// Samples of the corners of divided pixels (subdivision.h), level by level: a film keeps them, for a level
// looks at those before.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "image/film/subdivision.h"

namespace trace {

class CornerSamples {
 public:
  /// The corners of one level whose homes are pixels of an area: row by row, of each pixel in the order of
  /// sortCorners().
  struct Level {
    Tile area{0, 0, 0, 0};
    std::vector<std::size_t> starts;  ///< start of each pixel's corners, and the end
    std::vector<Corner> corners;
    std::vector<std::vector<Color>> values;  ///< values of each corner: the colour, and what layers keep

    std::size_t pixel(int x, int y) const {
      return static_cast<std::size_t>(y - area.y0) * static_cast<std::size_t>(area.x1 - area.x0) +
             static_cast<std::size_t>(x - area.x0);
    }
    bool has(int x, int y) const { return x >= area.x0 && x < area.x1 && y >= area.y0 && y < area.y1; }
  };

  /// For a picture in tiles of that size, `columns` in a row.
  CornerSamples(const Subdivision& rules, int tileSize, int columns, std::size_t tiles)
      : rules_(rules), tileSize_(tileSize), columns_(columns), levels_(tiles) {
    clear();
  }

  const Subdivision& rules() const { return rules_; }
  int levels() const { return rules_.depth + 1; }

  void clear() {
    for (auto& tile : levels_) tile.assign(static_cast<std::size_t>(levels()), Level{});
  }
  void put(std::size_t tile, std::size_t level, Level samples) { levels_[tile][level] = std::move(samples); }
  const Level& level(std::size_t tile, std::size_t level) const { return levels_[tile][level]; }
  std::size_t tileOf(int x, int y) const {
    return static_cast<std::size_t>(y / tileSize_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x / tileSize_);
  }

  /// The value of the corner: the colour, or what a layer keeps of it. It has to be there.
  const Color& at(CornerPlace place, std::size_t value = 0) const;
  /// The corners of the pixel, for divide().
  auto of(int x, int y, std::size_t value = 0) const {
    return [this, x, y, value](Corner corner) -> const Color& { return at({x, y, corner}, value); };
  }

  /// How many corners of the first `levels` have the pixel as their home.
  std::size_t countOf(int x, int y, std::size_t levels) const;

  /// The corners of the level that are to be looked at and have the pixel as their home: the corners of
  /// squares of the level, in the pixel and its neighbours. What is asked of lower levels has to be there.
  std::vector<Corner> wanted(int x, int y, int level) const;
  /// The same corner as one of a pixel that uses it, when all levels up to its own are there.
  CornerPlace userOf(CornerPlace home) const;

 private:
  Subdivision rules_;
  int tileSize_, columns_;
  std::vector<std::vector<Level>> levels_;  ///< levels of each tile
};

}  // namespace trace
