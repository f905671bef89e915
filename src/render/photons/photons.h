// Photons: light that flies from what gives it off until it comes to rest (Jensen, Realistic Image Synthesis
// Using Photon Mapping, 2001).
#pragma once

#include "base/parallel.h"
#include "render/lights/lamps.h"
#include "render/maps/illumination_map.h"
#include "render/maps/photon_map.h"
#include "render/world/world.h"
#include "scene/settings.h"

namespace trace {

/// Light that mirrors and glass gather (section 4.4 and chapter 5: the caustic map with its projection map):
/// Settings::caustics photons fly to what mirrors or refracts, and come to rest on surfaces after it that
/// scatter. `lamps`, if any, and the environment send photons beside the lights of the scene; then there are
/// Settings::photons if the other number is 0. Empty if there are none, and of a job that was cancelled.
/// `pass` is the number of one of several maps of other photons: in later ones fewer of them, nearer to a
/// place, count, so that the mean of many is without the blur of one (Knaus and Zwicker, Progressive Photon
/// Mapping: A Probabilistic Approach, 2011).
PhotonMap causticMap(const World& world, const Settings& settings, const Lamps* lamps, Job& job,
                     int pass = 0);

/// The estimate with Settings::causticTexels, for points that have a map; photons give that of the others.
struct GatheredCaustics {
  PhotonMap photons;
  IlluminationMap texels;
};
GatheredCaustics gatheredCaustics(const World& world, const Settings& settings, const Lamps* lamps, Job& job);

/// Whether places that are seen look around by rays, which the photons end (section 7.4: final gathering).
/// Else the density estimate gives what is scattered there at once (Hachisuka, Ogaki and Jensen, Progressive
/// Photon Mapping, 2008).
inline bool gathersFinally(const Settings& settings) {
  return settings.finalGather || settings.irradianceCache > 0;
}

/// All light (section 4.3: the global map, and section 4.3.3: the volume map): Settings::photons photons fly
/// from lights, lamps and the environment. Every surface that scatters keeps those that arrive;
/// where they are seen at once only those that something has scattered before, for the rest is asked or a
/// caustic. Every medium keeps those that came there by way of something else.
struct GlobalMaps {
  PhotonMap surfaces, media;
};
GlobalMaps globalMaps(const World& world, const Settings& settings, const Lamps& lamps, Job& job,
                      int pass = 0);

/// By how much the area in which photons count is smaller in that pass than in the first: by
/// (n + alpha) / (n + 1) from pass n = 1 on to the next, alpha = 2/3 (equation 20 of the paper).
Real areaOfPass(int pass);

}  // namespace trace
