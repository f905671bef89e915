// The share of the light image of `bdpt` in a pixel, and the paths by which the brightest of it came.
#pragma once

#include <string>
#include <vector>

#include "app/session/session.h"
#include "render/picture/light_image.h"

namespace trace {

struct LightLandings {
  LightImagePixel image;
  /// "from a light by ball, ball and floor", of each of the image's brightest.
  std::vector<std::string> routes;
};

/// Landings on the pixel (x, y) of the session's picture, or of that region of it. After Session::build().
/// Takes about half as long as a render.
LightLandings lightLandings(const Session& session, const Region& region, int x, int y, Job& job);

}  // namespace trace
