// Photon mapping (Jensen, Realistic Image Synthesis Using Photon Mapping, 2001): paths of a path tracer,
// which photons end.
//
//   L = Le + sum over lights + lamp + what mirrors and glass throw there + photons around
//
// A path ends at the first surface that scatters: lights and lamps are asked, and the photons
// around tell the rest, those that mirrors and glass have thrown there by a map of their own. Each sample of
// a pixel takes the photons of the next pass (progressive photon mapping: Hachisuka, Ogaki and Jensen 2008).
// With final gathering (Jensen 2001, section 7.4) a path ends one ray later: photons of all light tell what
// that ray would find. With an irradiance cache such a ray is only sent where no place nearby, of those
// worked out beforehand, tells what it would bring.
//
// Use photon for light that is rare or small, and for caustics of the sun or of point lights seen through
// glass or in a mirror, which path and bdpt never find. Not where nothing may be blurred.
#pragma once

#include "render/integrators/path.h"
#include "render/maps/irradiance_cache.h"
#include "render/maps/photon_map.h"

namespace trace {

class PhotonTracer : public PathTracer, private Terminator {
 public:
  void prepare(const World& world, const Settings& settings, Job& job) override;

 private:
  Told begin(int sample) const override;
  bool knowsEmitter(const Told& told, RayKind kind) const override;
  Left addLight(Gather& sum, const Interaction& at, const Told& told, RayKind kind,
                const Sampler& numbers) const override;
  void addInMedium(Gather& sum, const ScatterPlace& at, const Told& told,
                   const Sampler& numbers) const override;

  // Light from photons that is computed at few places: integrators/photon_cache.cpp.
  class CacheFiller;
  void fillCache(const World& world, const Settings& settings, Job& job);
  bool addCached(Gather& sum, const Interaction& at) const;

  bool gathers_ = false;  ///< final gathering: rays use the photon map where they end
  struct Maps {
    PhotonMap all, caustics, media;
  };
  std::vector<Maps> maps_;  ///< maps of each pass
  IrradianceCache cache_;
};

}  // namespace trace
