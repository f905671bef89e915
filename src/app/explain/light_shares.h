// Where the light of a sample comes from, the most of it first: what a tree of hundreds of rays amounts to.
#pragma once

#include <string>
#include <vector>

#include "render/rays/ray_tree.h"

namespace trace {

/// Light of one source that got to the camera in one way.
struct LightShare {
  std::string from;  ///< "sun on floor, by reflection in ball"
  Color brings;      ///< to the pixel
  double share = 0;  ///< share of the luminance of all, including what was removed
};

/// How a ray comes from the camera: ", by reflection in ball and 3 more rays"; "" for the camera ray.
std::string wayText(int ray, const RayTree& tree, const Scene& scene);

/// Those whose share is not 0. The rays must be weighed.
std::vector<LightShare> lightShares(const RayTree& tree, const Scene& scene);

}  // namespace trace
