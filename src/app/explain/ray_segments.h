// A ray tree as coloured lines in space: what an OBJ file, a drawing and the studio show of it.
#pragma once

#include <vector>

#include "math/box.h"
#include "render/rays/ray_tree.h"

namespace trace {

struct RaySegment {
  int node = 0;  ///< index into RayTree::nodes
  RayLooks looks = RayLooks::camera;
  Vec3 from, to;
  bool leaves = false;  ///< it continues infinite; drawn in part
};

/// The medium that sent the path of the ray on; null if none did.
const MediumTerm* scatteredIn(const RayNode& node);

/// One for each ray, in the tree's order. What leaves the scene is drawn for a third of the tree's size.
std::vector<RaySegment> raySegments(const RayTree& tree);

/// Around the places that the rays came to and the lights that they asked; neither the camera nor what leaves
/// the scene, nor what is farther than `reach` from where the first of them ended. Empty if there are none.
Box3 boundsOf(const std::vector<RaySegment>& segments, Real reach = kInfinity);

}  // namespace trace
