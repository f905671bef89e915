// The interface of integrators: the ways to find the light that comes along a camera ray. A new one is one
// file, one value of the enum IntegratorKind (scene/settings.h), one row of scene/integrators.cpp and its
// maker in integrators/make_integrator.cpp.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "render/rays/tracer.h"
#include "render/samples/sampler.h"
#include "scene/integrators.h"

namespace trace {

/// Light that a path threw at a place of the picture, (0, 0) at the bottom left: if light fell evenly, the
/// mean of its colours over the whole picture would be the colour of every pixel.
struct Thrown {
  Vec2 place;
  Color color;
  int light = 0;  ///< how many places the path has, without the camera
};

/// A camera ray and the first surface that it hits.
struct CameraRay {
  /// One whose hit is that of `cast(inside)`, which changes what it is inside of.
  template <class Cast>
  CameraRay(const Ray& r, const Interfaces& start, const Cast& cast)
      : ray(r), inside(start), hit(cast(inside)) {}

  Ray ray;
  Interfaces inside;  ///< what the ray is in when it gets there
  std::optional<Hit> hit;
  Real weight = 1;                               ///< what its radiance counts in the mean of the pixel
  const Differentials* differentials = nullptr;  ///< null if no footprints are needed
  Real ink = 0;                                  ///< how much of the sample is an outline, which is black
  std::vector<Thrown>* thrown = nullptr;         ///< takes what lands elsewhere; null if not needed
};

/// There is one for a render; it never changes once it is prepared.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Prepares the integrator before the first ray, such as a photon map. `job` tells how far it is and may
  /// be cancelled.
  virtual void prepare(const World&, const Settings&, Job&) {}

  /// It looks at Hit::opacity; for others it is random whether a ray hits a partly open surface.
  virtual bool weighsHoles() const { return false; }

  /// The radiance that arrives along the camera ray, which is the one cast last.
  virtual Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const = 0;

  /// Adds the light of the sample at other pixels of the picture, to the same bits as radiance() with
  /// CameraRay::thrown, without the path from the camera.
  virtual void throwLight(Tracer&, const Sampler&, std::vector<Thrown>&) const {}
};

/// The target of a camera ray: the world at one moment, and the integrator that was prepared for it. A render
/// has one, or several while the shutter is open.
struct Moment {
  const World* world;
  const Integrator* integrator;
  const struct PassFacts* facts = nullptr;  ///< for passes that need them: render/picture/pass_facts.h
};

}  // namespace trace
