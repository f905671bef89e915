// A ray tree for people: one block of lines per ray, indented under the ray that sent it.
#pragma once

#include <string>
#include <vector>

#include "app/explain/chain_walk.h"
#include "app/explain/explained_rays.h"
#include "app/explain/light_landings.h"
#include "render/picture/explain.h"
#include "scene/scene.h"

namespace trace {

/// The pixel that the tree belongs to and whether it agrees with the picture.
struct PixelFacts {
  const Scene& scene;
  const Explanation& explanation;
  const std::vector<ExplainedRay>& rays;  ///< rays of its tree
  int width = 0, height = 0;              ///< width and height of the picture
  Color rendered;                         ///< the pixel, from a render
  Settings settings{};
  /// Chains make the picture that was asked for: the one that comes nearest to the pixel. Then the settings
  /// are those of `path`. Else null.
  const ChainWalk* chain = nullptr;
  const LightLandings* light = nullptr;  ///< what the light image brings; null where nobody asked
  /// The tree's sum, the pixel's samples and the render agree bit for bit.
  bool agrees() const;
};

/// Lines of about 100 columns; with colours of a terminal if asked.
std::string explainText(const PixelFacts& facts, bool color);

}  // namespace trace
