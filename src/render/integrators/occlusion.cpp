#include "render/integrators/occlusion.h"

#include "render/paths/interaction.h"

namespace trace {

Color Occlusion::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Gather sum(tracer, 0);
  if (camera.hit) {
    const Interaction at(tracer, camera.ray, *camera.hit, camera.differentials, camera.inside, 0.5);
    sum.note(at.bsdf());
    sum.note(at.raised());
    at.addOpen(sum, Term::Kind::bounce, Color(1), 1, sampler);
  } else {
    sum.add(Term::Kind::background, Color(1));
  }
  sum.draw(camera.ink);
  return sum.radiance();
}

}  // namespace trace
