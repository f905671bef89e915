// A ray tree as coloured lines in space: what an OBJ file, a drawing and the studio show of it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "math/color.h"
#include "render/ray_tree.h"

namespace trace {

/// How a ray looks. THE table of colours, which stay apart for colour-blind eyes (Okabe and Ito 2008) and on
/// white and black.
struct RayLook {
  std::string_view name;  ///< one word
  std::string_view help;  ///< of a legend
  Color color;            ///< of the screen, as levels from 0 to 1
};
enum class RayLooks { camera, reflection, refraction, shadowLit, shadowBlocked };
inline constexpr std::array<RayLook, 5> kRayLooks{{
    {"camera", "camera ray", {0.35, 0.35, 0.35}},
    {"reflection", "reflected", {0, 0.447, 0.698}},
    {"refraction", "refracted", {0, 0.62, 0.451}},
    {"shadow-lit", "shadow ray that reaches its light", {0.902, 0.624, 0}},
    {"shadow-blocked", "shadow ray that is blocked", {0.835, 0.169, 0.169}},
}};
constexpr const RayLook& look(RayLooks looks) { return kRayLooks[static_cast<std::size_t>(looks)]; }

struct RaySegment {
  int node = 0;  ///< index into RayTree::nodes
  RayLooks looks = RayLooks::camera;
  Vec3 from, to;
  bool leaves = false;  ///< it goes on without end; drawn in part
};

/// One for each ray, in the tree's order. What leaves the scene is drawn for a third of the tree's size.
std::vector<RaySegment> raySegments(const RayTree& tree);

/// A Wavefront OBJ file of the segments as lines, a group for each look, `# ray N` before each.
std::string raysAsObj(const RayTree& tree);

}  // namespace trace
