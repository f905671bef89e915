// The scene's camera in words, as the options make it.
#pragma once

#include <string>

#include "scene/settings.h"

namespace trace {

/// "pinhole camera", "camera with a lens of aperture 0.2", "fisheye camera".
std::string cameraSentence(const Settings& settings);

}  // namespace trace
