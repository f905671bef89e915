#include "render/samples/picture_size.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace trace {

Size pictureSize(const Settings& settings, const Camera& camera) {
  constexpr double kMost = 1 << 20;
  const double aspect = camera.aspectratio * eyesAcross(settings.stereo);
  const int width = settings.width * (isAnaglyph(settings.stereo) ? 2 : 1);
  double height = settings.height;
  if (settings.height == 0) height = std::max(1.0, std::floor(width / aspect + 0.5));
  if (!(height <= kMost))
    throw Error(Fault::limit,
                "the picture would be " + std::to_string(settings.width) + " pixels wide and more than " +
                    std::to_string(static_cast<int>(kMost)) + " high",
                "the camera's aspect ratio (width / height) is very small; --height N sets the height");
  return {width, static_cast<int>(height)};
}

Tile areaOf(const Region& region, const Size& size) {
  const Tile whole{0, 0, size.width, size.height};
  return region.whole() ? whole : intersection(whole, {region.x0, region.y0, region.x1, region.y1});
}

}  // namespace trace
