// Fewer triangles that look alike from afar, for frames that must not be late.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trace {

/// About so many triangles of those whose corners `indices` names, or all if they are no more: indices, three
/// for each triangle. `corners`: position and normal, six floats for each. Sharp edges stay as they are,
/// unless the rest could not be simplified enough (Garland and Heckbert, "Surface simplification using
/// quadric error metrics", 1997; else by clusters of corners). Its time is about linear.
std::vector<std::uint32_t> simplified(std::span<const std::uint32_t> indices, std::span<const float> corners,
                                      std::size_t triangles);

}  // namespace trace
