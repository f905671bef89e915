// Distances to points strewn in space, one in each cube of a lattice (Worley, A Cellular Texture Basis
// Function, SIGGRAPH 1996).
#pragma once

#include "shading/textures/pattern.h"

namespace trace {

/// The distances to the nearest point and to the second, and what the nearest one's cube hashes to.
struct CellDistances {
  Real first = kInfinity, second = kInfinity;
  std::uint32_t bits = 0;
};

inline std::uint32_t cellBits(const std::int64_t* cell, int axes, std::uint32_t seed) {
  for (int axis = 0; axis < axes; ++axis) seed += axisBits(cell[axis], axis);
  return mixBits32(seed);
}

/// Where in the cube its point lies: coordinates from 0 to 1.
inline Vec3 cellPoint(const std::int64_t* cell, int axes, Real jitter, std::uint32_t seed) {
  Vec3 point;
  std::uint32_t bits = cellBits(cell, axes, seed);
  for (int axis = 0; axis < axes; ++axis) {
    bits = bits * 0x915f77f5u + 0x9e3779b9u;  // a step of a generator, whose upper bits are the better ones
    point[axis] = 0.5 + jitter * ((bits ^ bits >> 15) * 0x1p-32 - 0.5);
  }
  return point;
}

/// `axes`: 2 or 3. `jitter`: how far a point may lie from the middle of its cube; 1 is anywhere in it.
inline CellDistances cellDistances(const Vec3& p, int axes, Real jitter, std::uint32_t seed) {
  // The second point is at most sqrt(17) / 2 away, that of the nearer neighbour along an axis, so it lies no
  // more than three cubes away. A cube that cannot come nearer is not looked into.
  constexpr std::int64_t kAway[]{0, -1, 1, -2, 2, -3, 3};
  std::int64_t whole[3] = {};
  Real rest[3] = {}, slab[3][7] = {};
  for (int axis = 0; axis < axes; ++axis) {
    const Lattice at(p[axis]);
    whole[axis] = at.whole;
    rest[axis] = at.rest;
    for (int i = 0; i < 7; ++i) {
      const auto low = static_cast<Real>(kAway[i]);
      const Real gap = max(max(low - rest[axis], rest[axis] - (low + 1)), 0);
      slab[axis][i] = gap * gap;
    }
  }
  CellDistances found;  // squared, until the end
  for (int k = 0; k < (axes == 3 ? 7 : 1); ++k) {
    if (slab[2][k] >= found.second) continue;
    for (int j = 0; j < 7; ++j) {
      if (slab[2][k] + slab[1][j] >= found.second) continue;
      for (int i = 0; i < 7; ++i) {
        if (slab[2][k] + slab[1][j] + slab[0][i] >= found.second) continue;
        const std::int64_t cell[3]{whole[0] + kAway[i], whole[1] + kAway[j], whole[2] + kAway[k]};
        const Vec3 own = cellPoint(cell, axes, jitter, seed);
        Real squared = 0;
        for (int axis = 0; axis < axes; ++axis) {
          const Real d = static_cast<Real>(cell[axis] - whole[axis]) + own[axis] - rest[axis];
          squared += d * d;
        }
        if (squared < found.first) {
          found.second = found.first;
          found.first = squared;
          found.bits = cellBits(cell, axes, seed);
        } else if (squared < found.second) {
          found.second = squared;
        }
      }
    }
  }
  found.first = std::sqrt(found.first);
  found.second = std::sqrt(found.second);
  return found;
}

enum class CellValue { f1, f2, border, cell };
constexpr std::array<std::string_view, 4> names(CellValue) { return {"f1", "f2", "f2-f1", "cell"}; }

struct Cells : PatternColors {
  static constexpr std::string_view kKeyword = "cells";
  static constexpr std::string_view kHelp = "Worley's cells: distances to points scattered in space";

  CellValue value = CellValue::f1;
  Real jitter = 1;
  TextureSpace space = TextureSpace::point;
  int seed = 0;

  static constexpr auto fields() {
    return Fields{
        PatternColors::fields(),

        Field{"value", &Cells::value, "", -kNoLimit, kNoLimit,
              "the distance to the nearest point, to the second, their difference, or a number for each "
              "cell"},
        Field{"jitter", &Cells::jitter, "", 0, 1, "how far points leave the middle of their cube"},
        Field{"space", &Cells::space, "", -kNoLimit, kNoLimit, "solid, or in u and v"},
        Field{"seed", &Cells::seed, "", -kNoLimit, kNoLimit, "chooses among patterns of the same kind"}};
  }
  bool operator==(const Cells&) const = default;

  Real pattern(const TexturePlace& place) const {
    const PatternPlace p(place, space);
    const CellDistances d = cellDistances(p.at, space == TextureSpace::uv ? 2 : 3,
                                          std::clamp(jitter, 0.0, 1.0), static_cast<std::uint32_t>(seed));
    switch (value) {
      case CellValue::f1: break;
      case CellValue::f2: return d.second;
      case CellValue::border: return d.second - d.first;
      case CellValue::cell: return mixBits32(d.bits ^ 0x5bd1e995u) * 0x1p-32;
    }
    return d.first;
  }
  Color at(const TexturePlace& place) const { return shade(pattern(place)); }
};

}  // namespace trace
