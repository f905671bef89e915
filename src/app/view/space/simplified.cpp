// meshoptimizer's simplifier, which only this file sees.
#include "app/view/space/simplified.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace trace {

std::vector<std::uint32_t> simplified(std::span<const std::uint32_t> indices, std::span<const float> corners,
                                      std::size_t triangles) {
  constexpr std::size_t kFloats = 6, kStride = kFloats * sizeof(float);
  constexpr float kError = 0.05f, kAnyError = 1;  // relative to the surface's size
  std::vector<std::uint32_t> fewer(indices.begin(), indices.end());
  if (indices.size() <= 3 * triangles) return fewer;
  // Its work is by the number of corners: it gets only those that may be in use.
  const auto [low, high] = std::minmax_element(indices.begin(), indices.end());
  const std::uint32_t first = *low;
  const std::size_t count = *high - first + 1;
  const float* positions = corners.data() + kFloats * first;
  std::vector<std::uint32_t> given;
  given.reserve(indices.size());
  for (const std::uint32_t i : indices) given.push_back(i - first);
  fewer.resize(meshopt_simplify(fewer.data(), given.data(), given.size(), positions, count, kStride,
                                3 * triangles, kError, 0, nullptr));
  if (fewer.size() > 2 * 3 * triangles) {
    fewer.resize(given.size());
    fewer.resize(meshopt_simplifySloppy(fewer.data(), given.data(), given.size(), positions, count, kStride,
                                        3 * triangles, kAnyError, nullptr));
  }
  for (std::uint32_t& i : fewer) i += first;
  return fewer;
}

}  // namespace trace
