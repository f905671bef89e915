#include "render/picture/seen_behind.h"

#include "render/paths/onward.h"

namespace trace {

std::optional<SeenBehind> seenBehind(Tracer& tracer, const CameraRay& camera, const Sampler& sampler) {
  std::optional<SeenBehind> seen;
  CameraRay at = camera;
  Sampler numbers = sampler.branch(Branch::hole);
  for (int depth = 0; at.hit && depth < tracer.settings().depth; ++depth) {
    const Interaction place(tracer, at.ray, *at.hit, at.differentials, at.inside, 0.5);
    const auto next = isGlossy(place.bsdf()) ? std::nullopt : strongestOf(place);
    const Color spread = scatter(place.bsdf(), place.frame, place.normal, -at.ray.direction).diffuse;
    if (!next || maxComponent(spread) > maxComponent(next->weight)) break;
    const Real way = at.hit->t * length(at.ray.direction);
    CameraRay last{at.hit->leave(next->direction), {}, next->in(at.inside)};
    last.hit = tracer.cast(last.ray, next->kind, last.inside, tracer.chance(numbers));
    const Color passes = seen ? seen->passes : Color(1);
    const Real distance = seen ? seen->distance : 0;
    at = last;
    seen = {std::move(last), passes * next->weight, distance + way};
  }
  return seen;
}

}  // namespace trace
