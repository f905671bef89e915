// What a render warns of, since nobody wants it: before it begins, what was chosen or said and changes
// nothing, and an integrator that does not suit the scene; when it ends, what is not exact in the picture.
#pragma once

#include <string>

#include "base/error.h"
#include "render/world.h"
#include "scene/settings.h"

namespace trace {

/// Of options that change nothing, and of an integrator for which the scene has no light, or no end of light.
void warnOfSettings(const Scene& scene, const Settings& settings, const World& world, Messages& messages);

/// Of the first material that says what a medium does where it is nowhere dense.
void warnOfEmptyMedia(const Scene& scene, Messages& messages);

/// Of each name in the links of lights and objects that nothing has.
void warnOfWrongLinks(const Scene& scene, Messages& messages);

/// Of the first light whose light through a body of glass the integrator cannot find: the glass has no
/// caustic.
void warnOfMissingCaustics(const Scene& scene, const Settings& settings, const World& world,
                           Messages& messages);

/// What a user should know of the brightness of a picture by chains, whose standard error is `error` of it;
/// "" where that is exact enough.
std::string brightnessDoubt(const Settings& settings, Real error);

}  // namespace trace
