// Where the two paths of Bidirectional are joined: s = 1 and beyond, t = 2 and beyond.
#include "math/low_discrepancy.h"
#include "render/integrators/bdpt_paths.h"
#include "render/lights/light_choice.h"
#include "render/rays/firefly.h"
#include "render/rays/fog.h"

namespace trace {

void Bidirectional::joinAll(Gather& sum, const PathPlace& at, const Path& path, const Counts& counts,
                            const Color& factor, const Sampler& sampler, const Sample& sample) const {
  if (!at.joins()) return;
  if (sample.ways.shows(1, path.t())) {
    askLights(sum, at, path, factor, sampler, sample);
    askLamps(sum, at, path, factor, sampler, sample);
  }
  for (const LightPlace& place : sample.lights) join(sum, at, path, counts, factor, place, sampler, sample);
}

/// s = 1: the scene's lights.
void Bidirectional::askLights(Gather& sum, const PathPlace& at, const Path& path, const Color& factor,
                              const Sampler& sampler, const Sample& sample) const {
  Tracer& tracer = sum.tracer();
  const World& world = tracer.world();
  const int t = path.t();
  const Interaction* surface = at.surface();
  const Vec3& from = at.point();
  const auto ask = [&](const AskedLight& asked, const Vec2& place, Real part, std::uint32_t n) {
    const std::uint32_t i = asked.light;
    auto arriving = world.illuminate(i, from, place);
    if (!arriving || !(dot(arriving->toLight, arriving->toLight) > 0)) return;  // from beyond all numbers
    const Vec3& toLight = arriving->toLight;
    const Ray ray = at.leave(toLight);
    arriving->attenuation *= Fog(tracer.settings()).left(ray, arriving->distance);
    // No path from the light brings what it adds to highlights: that is found here alone.
    Illumination more = *arriving;
    more.color = arriving->extraHighlight = Color(0);
    const Color all = factor * at.scattered(*arriving) * part;
    const Color extra = isBlack(more.extraHighlight) ? Color(0) : factor * at.scattered(more) * part;
    if (isBlack(all) && isBlack(extra)) return;
    // Parallel light starts no path in a medium.
    const bool starts = surface || arriving->distance < kInfinity;
    const Real others =
        path.partial.others(starts ? starts_.overAsked(world, i, *arriving, from) * at.cosine(toLight) : 0,
                            at.density(toLight, at.from()));
    const Real counts = share(1, t, others, sample);
    if (!(counts > 0)) return;
    const Color passed = at.visible(tracer, ray, arriving->distance,
                                    sampler.branch(Branch::bdptToLamp).branch(asked.branch).branch(n));
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
  trace::askLights(tracer, from, surface ? &surface->normal : nullptr, sampler, [&](const AskedLight& asked) {
    if (surface && !world.lights(asked.light, surface->hit.object)) return;
    if (!world.lightHasSize(asked.light)) return ask(asked, kCenter, asked.share, 0);
    const int rays = surface ? tracer.settings().lightSamples : 1;
    const Vec2 first = asked.numbers().next2();
    for (int n = 0; n < rays; ++n) {
      const auto number = static_cast<std::uint32_t>(n);
      ask(asked, rotated(sobolPoint(number), first), asked.share / rays, number);
    }
  });
}

/// s = 1: one place of an emissive object, or of the sky.
void Bidirectional::askLamps(Gather& sum, const PathPlace& at, const Path& path, const Color& factor,
                             const Sampler& sampler, const Sample& sample) const {
  if (lamps_.empty()) return;
  Tracer& tracer = sum.tracer();
  Sampler numbers = sampler.branch(Branch::lamp);
  const Real which = numbers.next();
  auto place = lamps_.choose(at.point(), which, numbers.next2());
  if (!place) return;
  const Vec3& toLight = place->toLight;
  const int t = path.t();
  Color light = factor * at.scattered(at.from(), toLight);
  if (isBlack(light)) return;
  const bool starts = at.surface() || place->distance < kInfinity;
  const Real others =
      Partial::power(at.density(at.from(), toLight) / place->density) +
      path.partial.others(starts ? starts_.overAsked(*place, at.point()) * at.cosine(toLight) : 0,
                          at.density(toLight, at.from()));
  Real counts = share(1, t, others, sample);
  if (!(counts > 0)) return;
  const Ray ray = at.leave(toLight);
  const Color seen = [&] {
    const Tracer::Joining joining(tracer);
    return lamps_.look(tracer, ray, *place, at.side(toLight), tracer.chance(numbers));
  }();
  if (tracer.passedShadowless()) counts = share(1, t, 0, sample);
  if (!tracer.world().media().empty() && !isBlack(seen))
    light *= passedByBodies(tracer, ray, place->distance, sampler.branch(Branch::bdptToLamp));
  sum.addWay(Term::Kind::lamp, light * (counts / place->density), seen, ConnectionTerm{1, t, counts});
}

/// s > 1 and t > 1.
void Bidirectional::join(Gather& sum, const PathPlace& at, const Path& path, const Counts& counts,
                         const Color& factor, const LightPlace& light, const Sampler& sampler,
                         const Sample& sample) const {
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
  const Interfaces side = at.side(direction);
  Color all = here * there * light.power * (counted / distance2);
  if (at.inside().wavelength == 0) all *= light.response;
  if (!side.nested()) all *= side.passed(distance);
  if (const Fog fog(tracer.settings()); !fog.none() && isInOpenAir(side, tracer.world()))
    all *= Color(fog.passes(ray, distance));
  const Tracer::Joining joining(tracer);
  const Color passed = at.visible(tracer, ray, distance * Lamps::kBefore,
                                  sampler.branch(Branch::join).branch(static_cast<std::uint32_t>(s)));
  sum.addWay(Term::Kind::joined, all * allowedPart(tracer, path.weight * all * passed), passed,
             ConnectionTerm{s, t, counted});
}

}  // namespace trace
