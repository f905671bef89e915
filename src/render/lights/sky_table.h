// Where the light around the scene comes from: a table of its brightness by direction, by which directions
// are chosen (Pharr, Jakob and Humphreys, Physically Based Rendering, 3rd edition, 2016, section 14.2.4).
#pragma once

#include <vector>

#include "render/world/outside.h"

namespace trace {

class SkyTable {
 public:
  SkyTable() = default;
  /// The table of what bounced rays see. It is empty where they see nothing or the same everywhere, and also,
  /// unless the sky is found `onlyHere`, where it is nowhere much brighter than elsewhere: then there is
  /// nothing to be gained by a choice.
  SkyTable(const Outside& outside, int threads, bool onlyHere = false);

  bool empty() const { return rowSums_.empty(); }
  /// A unit direction, chosen by two numbers from 0 up to 1.
  Vec3 choose(const Vec2& u) const;
  /// With which choose() gives the unit direction, per solid angle.
  Real density(const Vec3& direction) const;

 private:
  // Rows are bands of y between two heights, so that all cells cover the same solid angle.
  static constexpr int kColumns = 1024, kRows = 512;
  static std::size_t cell(int row, int column) { return static_cast<std::size_t>(row * kColumns + column); }

  std::vector<float> sums_;    ///< in each row, of the cells up to and with this one
  std::vector<Real> rowSums_;  ///< row sums of the rows up to and with this one
};

}  // namespace trace
