// One pixel again, with a record of every ray: why it has its colour.
#pragma once

#include <functional>
#include <vector>

#include "render/picture/render.h"
#include "render/rays/ray_tree.h"
#include "render/world/world.h"
#include "scene/settings.h"

namespace trace {

struct Explanation {
  RayTree tree;                ///< tree of the requested sample
  std::vector<Color> samples;  ///< all of the pixel's, in order; those that are not finite do not count
  bool settled = false;        ///< there are no more of them, because the noise target was met
  std::vector<Vec2> corners;  ///< where each lies in the pixel, from its lower left corner, if it was divided
  std::vector<Real> weights;  ///< what each counts in the pixel
  Color pixel;                ///< their weighted mean, of those that count: the picture's, bit for bit
};

/// Explains sample `sample` of the pixel (x, y), y = 0 at the top. The picture's size must be pictureSize().
/// Throws Error(Fault::usage) for a pixel or sample that the picture does not have, such as one after the
/// pixel settled, Error(Fault::limit) for one with more than kMostRecordedRays rays. `cancelled`, if any, is
/// asked after every sample; once it is true what has been found so far is returned.
Explanation explain(std::span<const Moment> moments, const Settings& settings, const Size& size, int x, int y,
                    int sample, const std::function<bool()>& cancelled = {});
/// Explains a pixel at one moment.
Explanation explain(const World& world, const Integrator& integrator, const Settings& settings,
                    const Size& size, int x, int y, int sample);

}  // namespace trace
