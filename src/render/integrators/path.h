// Path tracing (Kajiya, The Rendering Equation, 1986): all light, however often it is scattered.
//
//   L = Le + sum over lights + lamp + weight * L(one ray, chosen at random)
//
// Lights of the scene are asked one by one, as Whitted's tracer does. One place on the emissive objects is
// chosen at random; a bounced ray may also meet them, and the two are weighed by the power heuristic (Veach
// 1997, section 9.2.4). One of a surface's mirrored, refracted and scattered rays is followed.
// A ray that was bounced as often as the depth allows sends one more, which sees only emitters: so the
// last surface is lit in both ways, too. The ambient light is left out: what it stands for is traced.
//
// With photons a path ends at the first surface that scatters: lights and lamps are asked, and the photons
// around tell the rest, those that mirrors and glass have thrown there by a map of their own. Each sample of
// a pixel takes the photons of the next pass (progressive photon mapping: Hachisuka, Ogaki and Jensen 2008).
// With final gathering (Jensen 2001, section 7.4) a path ends one ray later: photons of all light tell what
// that ray would find. With an irradiance cache such a ray is only sent where no place nearby, of those
// worked out beforehand, tells what it would bring.
//
// Use path first: for lights in the open, and a sky that is the light. Not for lights behind glass or walls,
// or that shine at the ceiling: its rays rarely hit them, and a light without a size never.
// Use direct to see what indirect light adds, or as a fast preview. Not where light has to bounce.
// Use photon for light that is rare or small, and for caustics of the sun or of point lights seen through
// glass or in a mirror, which path and bdpt never find. Not where nothing may be blurred.
#pragma once

#include <memory>

#include "render/lights/lamps.h"
#include "render/maps/irradiance_cache.h"
#include "render/maps/photon_map.h"
#include "render/media/media.h"
#include "render/rays/gather.h"
#include "render/samples/integrator.h"

namespace trace {

class Interaction;

class PathTracer : public Integrator {
 public:
  /// straight: without bounces, only what comes from lights and lamps straight.
  enum class Light { straight, bounced, photons };
  explicit PathTracer(Light light) : light_(light) {}
  void prepare(const World& world, const Settings& settings, Job& job) override;
  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override;

 private:
  struct Path;
  struct Scattering;
  Color along(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
              const Interfaces& inside, const Sampler& sampler) const;
  Color arrives(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
                const Interfaces& inside, const Sampler& sampler, std::unique_ptr<Scattering>& after) const;
  Color scattered(Tracer& tracer, const Ray& ray, const MediumWay& way, const MediumWay::Place& place,
                  const Path& path, const Interfaces& inside, const Sampler& sampler,
                  std::unique_ptr<Scattering>& after) const;
  static ChanceTerm shines(const Path& path, Real other);
  void addLamp(Gather& sum, const Interaction& at, Real shareOfLobe, const Sampler& sampler) const;

  // Light from photons that is computed at few places: integrators/path_cache.cpp.
  class CacheFiller;
  void fillCache(const World& world, const Settings& settings, Job& job);
  bool addCached(Gather& sum, const Interaction& at) const;

  Light light_;
  bool gathers_ = false;      ///< final gathering: rays use the photon map where they end
  bool photonsTell_ = false;  ///< they tell what a place scatters that is seen
  int depth_ = 0;             ///< the most bounces
  int mostScattered_ = 1;     ///< the most times that media scatter
  Lamps lamps_;
  struct Maps {
    PhotonMap all, caustics, media;
  };
  std::vector<Maps> maps_;  ///< maps of each pass; one of empty ones without photons
  IrradianceCache cache_;
};

}  // namespace trace
