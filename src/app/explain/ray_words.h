// The end of a ray in few words: for a column of a table, and for a sentence on the stage.
#pragma once

#include <string>
#include <vector>

#include "render/rays/ray_tree.h"

namespace trace {

/// The light's name; "point_light 2" for the second of those point lights that have none.
std::string shortLightName(const Scene& scene, std::uint32_t light);

/// "glass ball", or "glass ball and pane": the objects that filter a shadow ray, each once; "" if none does.
std::string filtersOf(const RayNode& node, const Scene& scene);

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

/// Surfaces take a visible part of the light that comes along the shadow ray.
bool isFiltered(const RayNode& node);

/// "31 %" of a share from 0 to 1.
std::string percent(Real share);

/// Why the ray ended, in two or three words: "total reflection", "filtered to 31 %". sentence() says more.
std::string shortEnd(const RayNode& node);

/// The ray as a step of a story: "camera ray: hits floor, which neither mirrors nor transmits", "shadow ray:
/// reaches lamp from floor".
std::string stepOf(const RayTree& tree, const Scene& scene, int ray);

}  // namespace trace
