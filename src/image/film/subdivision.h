// Recursive subdivision of pixels: rays go through the corners of a pixel, and where these differ the pixel
// falls into four squares, and those again, so that rays are spent at edges (Whitted, An Improved
// Illumination Model for Shaded Display, 1980; Foley, van Dam, Feiner and Hughes, Computer Graphics, 1990,
// section 15.10.4). The pixel is the mean of its squares by their area, and a square that of its corners.
//
// A corner is one for all squares around it, so a pixel whose corners are alike costs one ray. It belongs to
// one pixel, its home: the one of whose lower left part it is, or at the rim of the picture the one that has
// it. Depth 3 turns a pixel into 8 x 8 squares at most.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "math/color.h"

namespace trace {

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct Tile {
  int x0, y0, x1, y1;
  bool operator==(const Tile&) const = default;
};

/// A place on the grid of the smallest squares of a pixel, from 0 to the number of these along its side: x
/// from the left, y from below.
struct Corner {
  std::uint8_t x = 0, y = 0;
  bool operator==(const Corner&) const = default;
};

/// A corner of a pixel; row y = 0 is the top.
struct CornerPlace {
  int x = 0, y = 0;
  Corner corner;
  bool operator==(const CornerPlace&) const = default;
};

/// How the pixels of a picture are divided.
struct Subdivision {
  int depth = 0;             ///< times; at most 6
  double threshold = 0;      ///< corners differ by more, as a part of white, or above white of the brightest
  Tile area{0, 0, 0, 0};     ///< that is rendered
  int seamX = 0, seamY = 0;  ///< the first pixel of the second eye's picture; 0: there is none

  int side() const { return 1 << depth; }  ///< side of a pixel, in smallest squares
  bool differ(const Color* const (&corners)[4]) const;

  /// The pixels around (x, y) that share corners: those of the area, in the picture of one eye.
  Tile around(int x, int y) const;
  /// The same corner as its home has it.
  CornerPlace home(CornerPlace place) const;
  /// How often a pixel was divided where the corner is one.
  int levelOf(Corner corner) const;
};

/// Divides a pixel: calls leaf(x, y, size) for each square that stays whole, with its lower left corner, and
/// before that split(x, y, size, level) for each that does not. `at(Corner)` gives what a corner sees; only
/// corners of the levels below `levels` are asked for.
template <class At, class Leaf, class Split>
void divide(const Subdivision& rules, int levels, const At& at, const Leaf& leaf, const Split& split,
            int x = 0, int y = 0, int level = 0) {
  const int size = rules.side() >> level, half = size / 2;
  const auto corner = [](int cx, int cy) {
    return Corner{static_cast<std::uint8_t>(cx), static_cast<std::uint8_t>(cy)};
  };
  const auto differ = [&] {
    return rules.differ({&at(corner(x, y)), &at(corner(x + size, y)), &at(corner(x, y + size)),
                         &at(corner(x + size, y + size))});
  };
  if (level >= levels || !differ()) return leaf(x, y, size);
  split(x, y, size, level);
  for (const auto& [dx, dy] : {std::pair{0, 0}, {half, 0}, {0, half}, {half, half}})
    divide(rules, levels, at, leaf, split, x + dx, y + dy, level + 1);
}

/// Calls use(Corner, share) for the corners of every square of a pixel that was divided `levels` times at
/// most. The shares of corners whose colour is not finite go to the others of their square; all others sum to
/// 1, unless a square has none.
template <class At, class Use>
void forEachShare(const Subdivision& rules, int levels, const At& at, const Use& use) {
  const auto leaf = [&](int x, int y, int size) {
    const double across = static_cast<double>(size) / rules.side();
    Corner corners[4];
    int count = 0;
    for (const int dy : {0, size})
      for (const int dx : {0, size}) {
        const Corner c{static_cast<std::uint8_t>(x + dx), static_cast<std::uint8_t>(y + dy)};
        if (isFinite(at(c))) corners[count++] = c;
      }
    for (int i = 0; i < count; ++i) use(corners[i], across * across / count);
  };
  divide(rules, levels, at, leaf, [](int, int, int, int) {});
}

/// The mean of value(Corner) over the pixel.
template <class At, class Value>
Color meanOver(const Subdivision& rules, int levels, const At& at, const Value& value) {
  Color sum;
  double shares = 0;
  forEachShare(rules, levels, at, [&](Corner corner, double share) {
    sum += value(corner) * share;
    shares += share;
  });
  return shares > 0 ? sum / shares : sum;
}

/// By their levels, then from below; each once.
void sortCorners(const Subdivision& rules, std::vector<Corner>& corners);

/// The corners of a pixel that was divided `levels` times at most: of the whole pixel first, then of each
/// level in turn, from below.
template <class At>
std::vector<Corner> cornersOf(const Subdivision& rules, int levels, const At& at) {
  std::vector<Corner> corners;
  const auto leaf = [&](int x, int y, int size) {
    for (const int dy : {0, size})
      for (const int dx : {0, size})
        corners.push_back({static_cast<std::uint8_t>(x + dx), static_cast<std::uint8_t>(y + dy)});
  };
  divide(rules, levels, at, leaf, [](int, int, int, int) {});
  sortCorners(rules, corners);
  return corners;
}

}  // namespace trace
