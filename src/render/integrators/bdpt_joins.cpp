// Where the two paths of Bidirectional are joined: s = 1 and beyond, t = 2 and beyond.
#include "render/integrators/bdpt_paths.h"
#include "render/lights/light_choice.h"
#include "render/media/lamp_light.h"
#include "render/rays/firefly.h"
#include "render/rays/fog.h"

namespace trace {

void Bidirectional::joinAll(Gather& sum, const PathPlace& at, const Path& path, const Counts& counts,
                            const Color& factor, const Sample& sample) const {
  if (!at.joins()) return;
  if (sample.ways.shows(1, path.t())) {
    askLights(sum, at, path, factor, sample);
    askLamps(sum, at, path, factor, sample);
  }
  for (std::size_t i = 0; i < sample.lights.size(); ++i)
    join(sum, at, path, counts, factor, sample.lights[i], sample);
}

/// s = 1: the scene's lights.
void Bidirectional::askLights(Gather& sum, const PathPlace& at, const Path& path, const Color& factor,
                              const Sample& sample) const {
  Tracer& tracer = sum.tracer();
  const World& world = tracer.world();
  const int t = path.t();
  const Interaction* surface = at.surface();
  const Vec3& from = at.point();
  const auto ask = [&](const AskedLight& asked) {
    const std::uint32_t i = asked.light;
    if (surface && !world.lights(i, surface->hit.object)) return;
    auto arriving = world.illuminate(i, from, asked.point);
    if (!arriving || !(dot(arriving->toLight, arriving->toLight) > 0)) return;  // from beyond all numbers
    const Vec3& toLight = arriving->toLight;
    const Ray ray = at.leave(toLight);
    arriving->attenuation *= Fog(tracer.settings()).left(ray, arriving->distance);
    // No path from the light brings what it adds to highlights: that is found here alone.
    Illumination more = *arriving;
    more.color = arriving->extraHighlight = Color(0);
    const Color all = factor * at.scattered(*arriving) * asked.share;
    const Color extra = isBlack(more.extraHighlight) ? Color(0) : factor * at.scattered(more) * asked.share;
    if (isBlack(all) && isBlack(extra)) return;
    // Parallel light starts no path in a medium.
    const bool starts = surface || arriving->distance < kInfinity;
    const Real others =
        path.partial.others(starts ? starts_.overAsked(world, i, *arriving, from) * at.cosine(toLight) : 0,
                            at.density(toLight, at.from()));
    const Real counts = share(1, t, others, sample);
    if (!(counts > 0)) return;
    const Color passed =
        at.visible(tracer, ray, arriving->distance,
                   path.numbers.branch(Branch::bdptToLamp).branch(asked.branch).branch(asked.n));
    const Real shadow = surface ? surface->material.shadow : 1, alone = share(1, t, 0, sample);
    const Real weight = tracer.passedShadowless() ? alone : counts;
    const Color counted = all * weight + extra * alone;
    sum.addWay(Term::Kind::light, counted * shadow, passed, ConnectionTerm{1, t, weight});
    if (!world.lightCastsShadows(i) && !(passed == Color(1)))  // no other strategy brings the rest
      sum.addWay(Term::Kind::light, (all + extra) * (alone * shadow), Color(1) + passed * -1,
                 ConnectionTerm{1, t, alone});
    if (shadow < 1)
      sum.addWay(Term::Kind::light, (all + extra) * (1 - shadow), Color(1), ConnectionTerm{1, t, 1});
  };
  const int points = surface ? tracer.settings().lightSamples : 1;
  trace::askLights(tracer, from, surface ? &surface->normal : nullptr, path.numbers, points, ask);
}

/// s = 1: one place of an emissive object, or of the sky.
void Bidirectional::askLamps(Gather& sum, const PathPlace& at, const Path& path, const Color& factor,
                             const Sample& sample) const {
  if (lamps_.empty()) return;
  Sampler numbers = path.numbers.branch(Branch::lamp);
  const Real which = lamps_.isOne() ? numbers.skip() : numbers.next();
  const Tracer::Joining joining(sum.tracer());
  const auto weigh = [&](const Lamps::Place& place, bool alone) {
    const Vec3& toLight = place.toLight;
    const Color light = factor * at.scattered(at.from(), toLight);
    if (isBlack(light)) return LampWeight<ConnectionTerm>{};
    const bool starts = at.surface() || place.distance < kInfinity;
    const Real others =
        alone
            ? 0
            : PartialSums::power(at.density(at.from(), toLight) / place.density) +
                  path.partial.others(starts ? starts_.overAsked(place, at.point()) * at.cosine(toLight) : 0,
                                      at.density(toLight, at.from()));
    const ConnectionTerm term{1, path.t(), share(1, path.t(), others, sample)};
    return LampWeight<ConnectionTerm>{light * (term.share / place.density), term};
  };
  askLamp(
      sum, lamps_, at, {which, numbers.next2()}, [&] { return numbers.next(); },
      [&] { return path.numbers.branch(Branch::bdptToLamp); }, weigh);
}

/// s > 1 and t > 1.
void Bidirectional::join(Gather& sum, const PathPlace& at, const Path& path, const Counts& counts,
                         const Color& factor, const LightPlace& light, const Sample& sample) const {
  const int s = light.s(), t = path.t();
  if (!sample.ways.shows(s, t) || !light.place.joins() || !allows(counts + light.counts, light.last)) return;
  const Vec3 way = light.place.point() - at.point();
  const Real distance2 = dot(way, way), distance = std::sqrt(distance2);
  if (!(distance > 0)) return;
  const Vec3 direction = way / distance, toEye = at.from(), from = light.place.from();
  const Color here = factor * at.scattered(toEye, direction);
  if (isBlack(here)) return;
  const Color there = light.place.scatteredOn(-direction, from, light.lit);
  if (isBlack(there)) return;
  const Real others =
      light.partial.others(at.density(toEye, direction) * light.place.cosine(direction) / distance2,
                           light.place.density(-direction, from)) +
      path.partial.others(light.place.density(from, -direction) * at.cosine(direction) / distance2,
                          at.density(direction, toEye));
  const Real counted = share(s, t, others, sample);
  if (!(counted > 0)) return;
  Tracer& tracer = sum.tracer();
  const Ray ray = at.leave(direction);
  Color all = here * there * light.power * (counted / distance2);
  if (at.inside().wavelength == 0) all *= light.response;
  all *= at.clear(tracer, ray, distance);
  const Tracer::Joining joining(tracer);
  const Color passed = at.visible(tracer, ray, distance * Lamps::kBefore,
                                  path.numbers.branch(Branch::join).branch(static_cast<std::uint32_t>(s)));
  sum.addWay(Term::Kind::joined, all * allowedPart(tracer, path.weight * all * passed), passed,
             ConnectionTerm{s, t, counted});
}

}  // namespace trace
