// The size of a picture in pixels, and the part of it that is rendered.
#pragma once

#include "image/film.h"
#include "scene/settings.h"
#include "shading/cameras/camera.h"

namespace trace {

struct Size {
  int width = 0, height = 0;
};
/// The size of the picture: height 0 in the settings becomes floor(width / aspect ratio + 0.5), at least 1.
/// Throws Error(Fault::limit) if that is beyond what a picture can have.
Size pictureSize(const Settings& settings, const Camera& camera);

/// The part of the picture that is rendered.
Tile areaOf(const Region& region, const Size& size);

}  // namespace trace
