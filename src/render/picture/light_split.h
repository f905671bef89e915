// The light of a sample by its source and by how often it was scattered: of the recorded rays, so that no
// integrator knows of it, and the parts sum to the sample's radiance.
#pragma once

#include <vector>

#include "math/color.h"
#include "render/picture/pass_facts.h"
#include "render/rays/ray_tree.h"

namespace trace {

/// The parts of one sample, by the numbers of PassNames::groups. Light is direct if it was scattered once at
/// most on its way from the source to the camera, counting reflection and refraction.
struct LightSplit {
  std::vector<Color> direct, indirect;
};

/// Splits the radiance of the camera ray of a tree, nodes[0]; without one all parts are black.
void splitLight(const RayTree& tree, const PassFacts& facts, std::size_t groups, LightSplit& split);

}  // namespace trace
