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

/// The materials at a point of a surface: one material, two, or those of a triangle's corners.
struct MaterialMix {
  static constexpr std::uint32_t kClear =
      std::numeric_limits<std::uint32_t>::max();  ///< in place of a material: as if nothing were there

  std::uint32_t material[3] = {};  ///< indices into Scene::materials
  Real weight[3] = {1, 0, 0};
  int count = 1;

  static MaterialMix only(std::uint32_t material) { return {{material, material, material}}; }
  /// `share` of the second, from 0 to 1.
  static MaterialMix between(std::uint32_t first, std::uint32_t second, Real share) {
    return {{first, second, second}, {1 - share, share, 0}, share > 0 ? 2 : 1};
  }
};

/// Materials between which a number leads, as indices into Scene::materials. None: the shape has one
/// material.
struct MaterialList {
  std::vector<std::uint32_t> indices;

  bool empty() const { return indices.empty(); }
  bool operator==(const MaterialList&) const = default;

  void addTo(std::vector<std::uint32_t>& all) const { all.insert(all.end(), indices.begin(), indices.end()); }
  /// From the first at 0 to the last at 1. Precondition: not empty.
  MaterialMix at(Real u) const {
    const Real place = std::clamp(u, 0.0, 1.0) * static_cast<Real>(indices.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(place), indices.size() - 1);
    const auto after = std::min(before + 1, indices.size() - 1);
    return MaterialMix::between(indices[before], indices[after], place - static_cast<Real>(before));
  }
};

}  // namespace trace
