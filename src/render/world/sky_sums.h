// The brightness of the environment by direction, summed over a grid of directions, so that some can be
// chosen by it (Pharr, Jakob and Humphreys, Physically Based Rendering, 3rd edition, 2016, section 14.2.4).
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "math/vec.h"

namespace trace {

class Outside;

struct SkySums {
  // Rows are bands of y between two heights, so that all cells cover the same solid angle.
  static constexpr int kColumns = 1024, kRows = 512;
  static std::size_t cell(int row, int column) { return static_cast<std::size_t>(row * kColumns + column); }

  std::vector<float> inRows;        ///< in each row, of the cells up to and with this one
  std::vector<Real> rows;           ///< row sums of the rows up to and with this one
  Real brightest = 0, darkest = 0;  ///< cells

  /// Sums what bounced rays see.
  SkySums(const Outside& outside, int threads);
};

/// Sums that are computed when somebody first needs them. All Worlds with this environment share them.
struct LazySkySums {
  std::mutex mutex{};
  std::shared_ptr<const SkySums> sums{};
};

}  // namespace trace
