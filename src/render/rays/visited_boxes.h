// The boxes of the hierarchies that one recorded ray visited, in the order of its visits: for the studio,
// which shows them one by one. Not a part of the RayTree, for there may be very many.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/rays/ray_tree.h"
#include "render/world/world.h"
#include "scene/settings.h"

namespace trace {

struct VisitedBox {
  /// The object whose triangles the box holds, as an index into Scene::objects; NodeWatch::kTop: whole
  /// objects.
  std::uint32_t object = NodeWatch::kTop;
  /// In world space; bits 0, 1 and 2 of the index say whether x, y and z of the object's space are high.
  std::array<Vec3, 8> corners;
};

/// Traces the ray once more: as many boxes as RayNode::nodes. None where no hierarchy was built.
std::vector<VisitedBox> visitedBoxes(const World& world, const Settings& settings, const RayNode& node);

}  // namespace trace
