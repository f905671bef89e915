// Whitted's recursive ray tracing (CACM 23(6), 1980), as the courses define it:
//
//   I = ke + ka Ia + sum over lights  Shadow Attenuation Il (kd max(0, N.L) + ks max(0, S)^n)
//     + kr I(mirrored ray) + kt I(refracted ray)
//
// The camera ray has depth 0; a ray of depth k makes new ones while k < the depth set. Nothing takes the
// place of the refracted ray under total internal reflection. kr and kt are constants, unless a Fresnel term
// is asked for. Extras: rough surfaces send a ray at random, photons show caustics, ambient light is asked
// for, emissive objects light others, and fog covers what is far.
//
// Use it for the pictures of the courses, and wherever one sample a pixel must do: sharp shadows, mirrors and
// glass without noise. Not for indirect light, which is a constant here, nor for lamps and skies that light a
// scene (lamp-samples asks them), nor for caustics without photons.
#pragma once

#include "render/lights/lamps.h"
#include "render/photons/photons.h"
#include "render/rays/gather.h"
#include "render/samples/integrator.h"

namespace trace {

class Interaction;
struct SubsurfaceBsdf;

class Whitted : public Integrator {
 public:
  void prepare(const World& world, const Settings& settings, Job& job) override;
  bool weighsHoles() const override { return true; }
  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override;

 private:
  struct Path;
  Color along(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
              const Interfaces& inside, const Sampler& sampler) const;
  Color follow(Tracer& tracer, const Ray& ray, const Path& path, Interfaces inside,
               const Sampler& sampler) const;

  void addBody(Gather& sum, const Interaction& at, const SubsurfaceBsdf& body, const Path& path,
               const Sampler& sampler) const;
  void seeMedia(Gather& sum, Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside,
                const Sampler& sampler) const;
  void addCaustics(Gather& sum, const Interaction& at) const;
  void addLamps(Gather& sum, const Interaction& at, bool glossy, const Sampler& sampler) const;

  GatheredCaustics caustics_;
  Lamps lamps_;  ///< empty where they light nothing
};

}  // namespace trace
