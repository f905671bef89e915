// Options that were chosen and change nothing in a scene: a warning for each, since nobody chooses them for
// that. Likewise where the integrator that was chosen does not suit the scene: there is no light for it, or
// no end of light.
#pragma once

#include "base/error.h"
#include "render/world.h"
#include "scene/settings.h"

namespace trace {

void warnOfIdleOptions(const Scene& scene, const Settings& settings, const World& world, Messages& messages);

/// The same of the first material that says what a medium does where it is nowhere dense.
void warnOfEmptyMedia(const Scene& scene, Messages& messages);

/// The same of each name in the links of lights and objects that nothing has.
void warnOfWrongLinks(const Scene& scene, Messages& messages);

}  // namespace trace
