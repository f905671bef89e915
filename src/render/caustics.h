// Light that mirrors and glass gather: photons that fly from the lights of the scene to what mirrors or
// refracts, and on until they meet a surface that scatters (Jensen 2001, section 4.4 and chapter 5: the
// caustic photon map with its projection map).
#pragma once

#include "base/parallel.h"
#include "render/photon_map.h"
#include "render/world.h"
#include "scene/settings.h"

namespace trace {

/// Settings::caustics photons from all lights together; those come to rest that were mirrored or refracted
/// before. Empty if there are none, and of a job that was cancelled.
PhotonMap causticMap(const World& world, const Settings& settings, Job& job);

}  // namespace trace
