// The size of a picture in pixels, and the part of it that is rendered.
#pragma once

#include <algorithm>

#include "image/film/film.h"
#include "scene/settings.h"
#include "shading/cameras/camera.h"

namespace trace {

struct Size {
  int width = 0, height = 0;
};

/// A pixel of a picture; y = 0 at the top.
struct PixelPlace {
  int x = 0, y = 0;
  bool operator==(const PixelPlace&) const = default;
};

/// The size of the picture: height 0 in the settings becomes floor(width / aspect ratio + 0.5), at least 1.
/// Throws Error(Fault::limit) if that is beyond what a picture can have.
Size pictureSize(const Settings& settings, const Camera& camera);

/// The area that both tiles share; x1 <= x0 or y1 <= y0 if there is none.
inline Tile intersection(const Tile& a, const Tile& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// The part of the picture that is rendered.
Tile areaOf(const Region& region, const Size& size);

}  // namespace trace
