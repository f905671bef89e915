#include "render/paths/path_place.h"

#include "render/rays/fog.h"

namespace trace {

Color PathPlace::scattered(const Illumination& arriving) const {
  // A light of colour 1 is one of irradiance pi.
  if (!at_) return arriving.intensity() * (kPi * phase(forward_, dot(along_, arriving.toLight)));
  Scatter parts = scatter(at_->bsdf(), at_->frame, arriving.toLight, from());
  parts.diffuse *= Color(1 - at_->coat);
  return arriving.scattered(parts);
}

Color PathPlace::clear(Tracer& tracer, const Ray& ray, Real distance) const {
  const Interfaces there = side(ray.direction);
  const Color passed = there.nested() ? Color(1) : there.passed(distance);
  const Fog fog(tracer.settings());
  return fog.none() || !isInOpenAir(there, tracer.world()) ? passed : passed * fog.passes(ray, distance);
}

Color PathPlace::visible(Tracer& tracer, const Ray& ray, Real distance, const Sampler& numbers) const {
  const Color passed = at_ ? tracer.visible(at_->hit, ray, distance, *inside_)
                           : tracer.visible(point_, ray.direction, distance, *inside_);
  return throughBodies(tracer, passed, ray, distance, numbers);
}

}  // namespace trace
