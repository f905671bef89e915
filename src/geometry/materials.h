// Which materials a place on a shape has that is made of several: operands of CSG, the colours of a fractal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "math/vec.h"

namespace trace {

/// Indices into Scene::materials, and how much the second counts, from 0 to 1.
struct MaterialShare {
  static constexpr std::uint32_t kClear =
      std::numeric_limits<std::uint32_t>::max();  ///< as if nothing were there

  std::uint32_t first = 0, second = 0;
  Real share = 0;
};

/// Materials between which a number leads, as indices into Scene::materials. None: the shape has one
/// material.
struct MaterialList {
  std::vector<std::uint32_t> indices;

  bool empty() const { return indices.empty(); }
  bool operator==(const MaterialList&) const = default;

  void addTo(std::vector<std::uint32_t>& all) const { all.insert(all.end(), indices.begin(), indices.end()); }
  /// From the first at 0 to the last at 1. Precondition: not empty.
  MaterialShare at(Real u) const {
    const Real place = std::clamp(u, 0.0, 1.0) * static_cast<Real>(indices.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(place), indices.size() - 1);
    const auto after = std::min(before + 1, indices.size() - 1);
    return {indices[before], indices[after], place - static_cast<Real>(before)};
  }
};

}  // namespace trace
