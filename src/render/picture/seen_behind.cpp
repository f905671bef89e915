#include "render/picture/seen_behind.h"

#include "render/paths/onward.h"

namespace trace {

std::optional<SeenBehind> seenBehind(Tracer& tracer, const CameraRay& camera, const Sampler& sampler) {
  std::optional<SeenBehind> seen;
  Sampler numbers = sampler.branch(Branch::hole);
  for (int depth = 0; depth < tracer.settings().depth; ++depth) {
    const CameraRay& at = seen ? seen->last : camera;
    if (!at.hit) break;
    const Interaction place(tracer, at.ray, *at.hit, at.differentials, at.inside, 0.5);
    const auto next = isGlossy(place.bsdf()) ? std::nullopt : strongestOf(place);
    if (!next) break;
    const Color spread = scatter(place.bsdf(), place.frame, place.normal, -at.ray.direction).diffuse;
    if (maxComponent(spread) > maxComponent(next->weight)) break;
    const Ray ray = at.hit->leave(next->direction);
    const auto cast = [&](Interfaces& inside) {
      return tracer.cast(ray, next->kind, inside, tracer.chance(numbers));
    };
    SeenBehind further{CameraRay(ray, next->in(at.inside), cast),
                       seen ? seen->passes * next->weight : next->weight,
                       (seen ? seen->distance : 0) + at.hit->t * length(at.ray.direction)};
    seen = std::move(further);
  }
  return seen;
}

}  // namespace trace
