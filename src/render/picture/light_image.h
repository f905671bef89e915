// One pixel of the light image of Bidirectional (t = 1): what paths from lights bring it, those that belong
// to the samples of all pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/picture/render.h"
#include "render/samples/integrator.h"

namespace trace {

/// A path from a light that landed in the pixel.
struct Landing {
  int x = 0, y = 0, sample = 0;  ///< the pixel and the sample that it belongs to
  int light = 0;                 ///< s: how many places it has, without the camera
  Color brings;                  ///< to the picture's pixel
};

struct LightImagePixel {
  static constexpr std::size_t kMostShown = 5;
  Color value;                         ///< its part of the finished picture's pixel, bit for bit
  std::int64_t paths = 0, landed = 0;  ///< paths of all samples, and of these those that landed here
  std::vector<Landing> brightest;      ///< at most kMostShown of them, the brightest first
};

/// Follows the light's end of all samples of the picture, about half of a render. Black where the integrator
/// throws nothing, pixels are divided, or (x, y) lies outside the region in the settings. A noise target is
/// not heeded: a picture that has one has fewer paths. Once `job` is cancelled what was found so far is
/// returned.
LightImagePixel lightImageAt(std::span<const Moment> moments, const Settings& settings, const Size& size,
                             int x, int y, Job& job);

}  // namespace trace
