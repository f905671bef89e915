// The paths that a sample of `bdpt` put together from both ends (Veach 1997, section 10.2), read from its
// tree of rays: which places each has, what it counts and what it brings.
#pragma once

#include <string>
#include <vector>

#include "render/rays/ray_tree.h"
#include "scene/settings.h"

namespace trace {

/// One path: `light` places from the light's end and `camera` from the camera's, which is one of them. One
/// that goes straight to the camera (camera = 1) lands in another pixel: it has no end here, and brings
/// nothing.
struct PathWay {
  int light = 0, camera = 0;
  int end = 0;       ///< the ray to the last place from the camera's end; -1: of camera = 1
  int start = -1;    ///< the ray to the last place from the light's end, of light > 1
  int between = -1;  ///< the ray that joins the two, or samples a light; -1: none
  Real share = 1;    ///< what it counts among all ways that find such paths
  Color brings;      ///< to the pixel
  int places() const { return light + camera; }
  /// The contribution if it were the only strategy.
  Color alone() const { return share > 0 ? brings / share : Color(); }
};

/// The shortest paths first, of these the ones with fewer places from the light's end. Empty of a tree that
/// no path from a light belongs to, and of none of `bdpt`.
std::vector<PathWay> pathWays(const RayTree& tree);

/// Why the tree of an integrator that joins paths from both ends has no ways.
std::string whyNoWays(const RayTree& tree, const Settings& settings);

/// The rays of the path, from the camera to the light.
std::vector<int> raysOf(const RayTree& tree, const PathWay& way);

/// "sampled a light: blocked by bowl".
std::string sentence(const PathWay& way, const RayTree& tree, const Scene& scene);

}  // namespace trace
