// Flat faces of different objects that lie in one plane and overlap: which is seen is left to rounding.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <utility>

#include "scene/scene.h"

namespace trace {

/// Pairs of objects, the lower number first, with such faces that both look to the side where the camera is,
/// and with a place on both that is seen: isSeen(place) is asked of a few. Faces are those of squares, boxes,
/// planes, disks, the ends of cylinders and cones, and triangles, as long as there are not more than
/// kMostFlatFaces. O(n log n) unless very many faces share one plane; then it gives up after
/// kMostOverlapTests, or kMostPlaces.
std::set<std::pair<std::uint32_t, std::uint32_t>> overlappingFaces(
    const Scene& scene, const std::function<bool(const Vec3&)>& isSeen);
inline constexpr std::size_t kMostFlatFaces = 1000000;
inline constexpr std::size_t kMostOverlapTests = 5000000;
inline constexpr std::size_t kMostPlaces = 20000;

}  // namespace trace
