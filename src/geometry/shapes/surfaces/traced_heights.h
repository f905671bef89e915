// The traced form of a grid of heights over x and y from -1 to 1.
//
// Along the ray, z minus the height of a patch is a polynomial: quadratic for bilinear patches, of degree six
// for bicubic ones (Catmull-Rom). Its sign says where the ray is below. The sign is carried from cell to
// cell, so that entries and exits take turns, whatever rounding does at the borders of cells.
#pragma once

#include <array>
#include <vector>

#include "geometry/ray.h"
#include "geometry/shapes/surfaces/heights.h"
#include "math/box.h"
#include "math/roots.h"

namespace trace {

class TracedHeights {
 public:
  /// At least 2 columns and rows; heights that are no numbers count as 0.
  TracedHeights(HeightGrid grid, Real floor, bool smooth, bool capped);

  bool solid() const { return capped_; }
  Box3 bounds() const { return box_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;
  std::int64_t partCount() const { return partsOf(grid_.columns, grid_.rows); }
  /// How many parts a grid of that size has.
  static std::int64_t partsOf(int columns, int rows) { return kSurface + std::int64_t{columns} * rows; }

 private:
  static constexpr std::int64_t kSurface = 6;  ///< part of the first cell; below: the faces of the box
  struct Reach {
    float least, most;
    bool operator==(const Reach&) const = default;
  };
  /// Blocks of 2, 4, 8 ... cells along each side.
  struct Level {
    int columns, rows;
    std::vector<Reach> blocks;
    const Reach& at(int column, int row) const {
      return blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
    }
  };
  /// z = sum of c[j][i] u^i v^j, u and v from 0 to 1 in the cell.
  struct Patch {
    std::array<std::array<Real, 4>, 4> c{};
    Real x0, y0, scaleX, scaleY;
    int terms;  ///< 2: bilinear, 4: bicubic
    /// The height, and its slopes in x and y.
    Real at(Real x, Real y, Real& slopeX, Real& slopeY) const;
  };
  struct Walk;

  Real planeX(int column) const { return -1 + 2 * (static_cast<Real>(column) / (grid_.columns - 1)); }
  Real planeY(int row) const { return -1 + 2 * (static_cast<Real>(row) / (grid_.rows - 1)); }
  Patch patch(int column, int row) const;
  /// Also of the columns and rows just outside of the grid, as the line through the last two continues.
  Real heightBeyond(int column, int row) const;
  Reach reachOf(int column, int row) const;
  int cellOf(Real place, int cells) const;
  /// z above the surface at the point, with its slope along the direction.
  Jet above(const Patch& patch, const Ray& ray, Real t) const;

  HeightGrid grid_;
  std::vector<Level> levels_;
  Box3 box_;
  bool smooth_, capped_;
  Real error_ = 0;
};

}  // namespace trace
