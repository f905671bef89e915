// Photons: light that flies from what gives it off until it comes to rest (Jensen, Realistic Image Synthesis
// Using Photon Mapping, 2001).
#pragma once

#include "base/parallel.h"
#include "render/illumination_map.h"
#include "render/lamps.h"
#include "render/photon_map.h"
#include "render/world.h"
#include "scene/settings.h"

namespace trace {

/// Light that mirrors and glass gather (section 4.4 and chapter 5: the caustic map with its projection map):
/// Settings::caustics photons fly to what mirrors or refracts, and come to rest on surfaces after it that
/// scatter. `lamps`, if any, and what is around send photons beside the lights of the scene; then there are
/// Settings::photons if the other number is 0. Empty if there are none, and of a job that was cancelled.
PhotonMap causticMap(const World& world, const Settings& settings, const Lamps* lamps, Job& job);

/// The same with Settings::causticTexels, for places that have a map; photons tell of the others.
struct GatheredCaustics {
  PhotonMap photons;
  IlluminationMap texels;
};
GatheredCaustics gatheredCaustics(const World& world, const Settings& settings, const Lamps* lamps, Job& job);

/// All light (section 4.3: the global map): Settings::photons photons fly from lights, lamps and what is
/// around the scene, and are kept by every surface that scatters them.
PhotonMap globalMap(const World& world, const Settings& settings, const Lamps& lamps, Job& job);

}  // namespace trace
