// The camera rays of a pixel and what they bring: the same for a render, for one pixel again, and for its
// explanation.
#pragma once

#include "render/footprint.h"
#include "render/integrator.h"
#include "render/outline.h"

namespace trace {

/// Takes a picture's samples, one at a time, by one worker.
class PixelTracer {
 public:
  /// `tree`, if any, records the rays. The integrator must outlive it.
  PixelTracer(const World& world, const Integrator& integrator, const Settings& settings, const Size& size,
              RayTree* tree = nullptr)
      : tracer_(world, settings, tree), integrator_(integrator), rules_(settings, size) {}

  /// How many a pixel has.
  int samples() const { return rules_.samples(); }

  /// What the camera ray of sample 0 <= k < samples() brings; may be NaN or infinite. Row y = 0 is the top.
  Color sample(int x, int y, int k) {
    return sample(x, y, k, [](const CameraRay&) {});
  }
  /// The same; look(CameraRay) sees the ray before it is followed.
  template <class Look>
  Color sample(int x, int y, int k, Look&& look) {
    const Sampler sampler(rules_, x, y, k);
    const World& world = tracer_.world();
    const CameraFrame& frame = world.camera();
    const auto [drawn, weight] = sampler.film();
    const Vec2 place = frame.inEyeOf(rules_.middle(x, y), drawn);
    const Vec2 lens = frame.optics.lens.radius > 0 ? sampler.branch(Sampler::kLens).next2() : kCenter;
    const Ray ray = frame.ray(place, lens);
    Footprint differentials;
    if (world.wantsFootprints()) differentials = differentialsAt(place, lens, ray);
    Interfaces inside = tracer_.interfacesAt(ray.origin);
    CameraRay camera{ray, tracer_.cast(ray, RayKind::camera, inside), std::move(inside), weight,
                     differentials.get()};
    if (tracer_.settings().outlines > 0) camera.ink = inkAt(tracer_, camera.hit, place, lens, rules_.size());
    look(camera);
    return integrator_.radiance(tracer_, sampler, camera);
  }

  Tracer& tracer() { return tracer_; }
  Statistics& statistics() { return tracer_.statistics(); }

 private:
  /// To the rays of the samples beside this one, whatever the camera is.
  [[gnu::noinline]] Footprint differentialsAt(const Vec2& film, const Vec2& lens, const Ray& ray) const {
    const CameraFrame& camera = tracer_.world().camera();
    const Vec2 step = rules_.spacing();
    const Ray x = camera.ray({film.x + step.x, film.y}, lens),
              y = camera.ray({film.x, film.y + step.y}, lens);
    return std::make_unique<const Differentials>(Differentials{x.origin - ray.origin, y.origin - ray.origin,
                                                               x.direction - ray.direction,
                                                               y.direction - ray.direction});
  }

  Tracer tracer_;
  const Integrator& integrator_;
  SampleRules rules_;
};

}  // namespace trace
