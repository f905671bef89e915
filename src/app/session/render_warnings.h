// Warnings of a render about options that have no effect, before it begins: options that were chosen and
// change nothing, and an integrator that does not suit the scene; when it ends, what is not exact in the
// picture.
#pragma once

#include <string>

#include "base/error.h"
#include "render/world/world.h"
#include "scene/settings.h"

namespace trace {

/// Warns of options that change nothing, and of an integrator for which the scene has no light, or no end of
/// light.
void warnOfSettings(const Scene& scene, const Settings& settings, const World& world, Messages& messages);

/// Warns of the first material that describes a medium with density 0 everywhere.
void warnOfEmptyMedia(const Scene& scene, Messages& messages);

/// Warns of each name in the links of lights and objects that nothing has.
void warnOfWrongLinks(const Scene& scene, Messages& messages);

/// Warns of the first light whose light through glass the integrator cannot find: the glass has no
/// caustic.
void warnOfMissingCaustics(const Scene& scene, const Settings& settings, const World& world,
                           Messages& messages);

/// A warning about the brightness of a picture by chains, whose standard error is `error` of it;
/// "" where that is exact enough.
std::string brightnessDoubt(const Settings& settings, Real error);

}  // namespace trace
