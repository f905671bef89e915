// The view of a RayTree in a window: classes of rays with names, where each ray is drawn from and to, its
// numbers in words, and how two trees differ.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/rays/ray_tree.h"

namespace trace {

/// The light that the ray adds to its sample, all channels; that of the camera ray is the sample itself.
Color addedLight(const RayTree& tree, int ray);
/// Its luminance.
Real share(const RayTree& tree, int ray);
/// "0.12 0.1 0.0813": red, green and blue, with so many significant digits.
std::string channels(const Color& c, int digits = 3);

/// The object, light or medium that the ray came to; "" if none.
std::string metBy(const RayTree& tree, const Scene& scene, int ray);

/// Name and value of everything that is known of the ray, in groups with a heading (an empty value).
std::vector<std::pair<std::string, std::string>> numbersOf(const RayTree& tree, int node, const Scene& scene);

/// Two trees side by side: nodes that correspond by their way from the camera ray, in the order of tracing.
struct RayPair {
  int a = -1, b = -1;  ///< nodes; -1 where the tree has none there
  int depth = 0;
  bool differs = false;  ///< in what it hit or brought back, or one is missing
  std::string what;      ///< in words; "" where nothing differs
};
std::vector<RayPair> difference(const RayTree& a, const Scene& sceneA, const RayTree& b, const Scene& sceneB);

}  // namespace trace
