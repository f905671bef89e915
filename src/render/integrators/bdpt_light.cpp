// The path from a light of Bidirectional, and where it lands in the picture: t = 1.
#include <algorithm>

#include "render/integrators/bdpt_paths.h"
#include "render/rays/fog.h"

namespace trace {

/// A path from a light on its way to the next place; its weight is its power.
struct Bidirectional::Flight : Leg, Bidirectional::Carried {
  std::optional<Hit> hit{};
  bool parallel = false;  ///< it comes straight from beyond all distances
  bool fromSky = false;   ///< ... from the environment
  /// Nothing has turned it. The next vertex is `way` farther from the light, which arrives there by its own
  /// law, and `through` is what remains of it.
  bool straight = true;
  Real way = 0;
  Color through{1};
  bool open = true;  ///< it has hit only what shadow rays pass, too: no vertices of the path, as if holes
  Real kept = 1;     ///< fraction of its power, where it was scattered last
};

/// The light that remains at its next vertex: where a medium scatters it, or on the surface.
Color Bidirectional::travels(Tracer& tracer, const Flight& f, std::optional<MediumWay::Place>& where) const {
  const Real far = f.hit ? f.hit->t : kInfinity;
  if (f.parallel) {  // sunlight loses nothing to fog
    Color passes =
        f.inside.passed(far) * passedByBodies(tracer, f.ray, far, f.numbers.branch(Branch::medium));
    if (const Fog fog(tracer.settings()); f.fromSky && !fog.none() && isInOpenAir(f.inside, tracer.world()))
      passes *= Color(fog.passes({f.hit->surface.point, -f.ray.direction}, kInfinity));
    return passes;
  }
  LegMedia media(tracer, f, far, f.counts.scatterings < mostScattered_ ? 1 : 0);
  where = media.place;
  if (where) return where->weight * f.inside.passed(where->t);
  return media.way ? media.way->passes * f.inside.passed(far) : f.inside.passed(far);
}

/// Keeps the places of a path from a light, and lets those land that the camera sees.
void Bidirectional::walkFromLight(Tracer& tracer, const Sampler& sampler, Sample& sample) const {
  const Strategies& ways = sample.ways;
  if (ways.light == 0 || ways.light == 1) return;
  Tracer::Aside aside(tracer);
  auto start = starts_.start(tracer, sampler);
  if (!start) return;
  const bool ofLight = start->light != LightStarts::kNoLight;
  Flight f{{start->ray, std::move(start->inside), sampler, RayKind::light},
           {},
           std::move(start->hit),
           start->parallel,
           start->parallel && !ofLight};
  while (f.hit || (isThick(tracer) && !f.parallel)) {
    aside.goOn();
    std::optional<MediumWay::Place> where;
    const Color passes = travels(tracer, f, where);
    if (!where && (!f.hit || f.counts.surfaces > depth_)) return;
    const Real t = f.way + (where ? where->t : f.hit->t);
    const bool lit = f.straight && ofLight;
    if (f.straight) {
      const auto arrival =
          starts_.arrives(tracer.world(), *start, where ? f.ray.at(where->t) : f.hit->surface.point, t);
      if (!arrival) return;
      f.weight = arrival->power * f.through;
      f.through *= passes;
      if (f.open) {
        f.partial = {PartialSums::power(arrival->asked), PartialSums::power(arrival->met)};
        f.last = where ? Last::medium : Last::lobe;
      }
    }
    f.kept = maxComponent(f.weight * passes) / maxComponent(f.weight);
    f.weight *= passes;
    if (isBlack(f.weight)) return;
    LightPlace& place = where ? sample.lights.push(f.ray, f.inside, *where)
                              : sample.lights.push(tracer, f.ray, f.inside, *f.hit, sample.shift);
    f.partial.arrive(f.parallel ? 1 : t * t, place.place.cosine(f.ray.direction));
    const bool linked = !lit || where || tracer.world().lights(start->light, f.hit->object);
    ++(where ? f.counts.scatterings : f.counts.surfaces);
    place.power = linked ? f.weight : Color(0);
    static_cast<Carried&>(place) = f;
    place.lit = lit;
    land(tracer, place, sample, f.numbers);
    if (!(where ? scatters(f, *where) : goesOn(f, place, sample))) return;
    if ((!linked && !f.straight) || (ways.light == place.s() && !f.open)) return;
    f.parallel = f.parallel && f.open;
    f.numbers = f.numbers.branch(Branch::next);
    f.hit = tracer.cast(f.ray, RayKind::light, f.inside, tracer.chance(f.numbers.branch(Branch::hole)));
  }
}

/// The flight is scattered by a medium; false if it ends.
bool Bidirectional::scatters(Flight& f, const MediumWay::Place& where) const {
  Sampler numbers = f.numbers.branch(Branch::choice);
  const Real goes = f.counts.keeps(f.kept);
  if (goes < 1 && !(numbers.next() < goes)) return false;
  f.weight *= Color(1 / goes);
  f.straight = f.open = false;
  f.way = 0;
  const PhaseSample to = samplePhase(f.ray.direction, where.forward, f.numbers.branch(Branch::lobe).next2());
  f.partial.leave(to.density, to.density, 1);
  f.ray = {f.ray.at(where.t), to.direction};
  return true;
}

/// The flight leaves the surface; false if it ends.
bool Bidirectional::goesOn(Flight& f, const LightPlace& place, const Sample& sample) const {
  const Interaction& at = *place.at;
  const bool passes = place.lit && f.open && at.tracer.lightPasses(at.bsdf());
  if (f.counts.surfaces > depth_ && !passes && !isThick(at.tracer)) return false;
  const Onward onward(at, sample.spectrum);
  Sampler choice = f.numbers.branch(Branch::choice);
  const auto next =
      onward.choose(onward.choice(choice), lobeNumbers(f.numbers.branch(Branch::lobe), hasOneLobe(at.bsdf())),
                    true, place.lit);
  if (!next) return false;
  const Color& weight = next->weight;
  const Real goes = f.counts.keeps(maxComponent(f.weight * weight) / maxComponent(f.weight));
  if (goes < 1 && !(choice.next() < goes)) return false;
  f.weight *= weight * (1 / goes);
  if (isBlack(f.weight)) return false;
  f.straight = place.lit && next->kind == RayKind::refraction && next->ratio == 1;
  f.open = f.straight && passes;
  f.way = f.straight ? f.way + f.hit->t : 0;
  f.through *= weight * (1 / goes);
  if (f.open) {
    --f.counts.surfaces;
  } else {
    f.partial.leave(place.place, *next, -f.ray.direction);
    if (f.counts.all() == 1 && !(next->density > 0)) f.last = Last::mirror;
  }
  if (f.inside.wavelength == 0 && next->in(f.inside).wavelength != 0) f.response = onward.response();
  f.ray =
      next->kind == RayKind::bounce ? at.leaveToLight(next->direction) : place.hit->leave(next->direction);
  if (next->behind) f.inside = *next->behind;
  return true;
}

/// t = 1: the camera sees the place. Where rays are recorded this one is, too, though it brings the pixel
/// nothing.
void Bidirectional::land(Tracer& tracer, const LightPlace& light, const Sample& sample,
                         const Sampler& sampler) const {
  const PathPlace& place = light.place;
  const int s = light.s();
  if (!lands_ || !(sample.thrown || tracer.records()) || !sample.ways.shows(s, 1) || !place.joins()) return;
  if (!allows(light.counts, light.last)) return;
  const Vec2 lens = camera_.hasLens() ? sampler.branch(Branch::lightLens).next2() : kCenter;
  const auto seen = camera_.sees(place.point(), lens);
  if (!seen || !tracer.world().camera().sees(seen->distance)) return;
  const Vec3 toEye = -seen->ray.direction, from = place.from();
  const Real distance2 = camera_.parallel() ? 1 : seen->distance * seen->distance;
  const Color factor = light.power * light.response * place.scatteredOn(toEye, from, light.lit);
  if (isBlack(factor)) return;
  const Real perArea = camera_.density(seen->ray) / distance2;
  const Real others = light.partial.others(perArea * place.cosine(toEye), place.density(toEye, from));
  const Real counts = share(s, 1, others, sample);
  if (!(counts > 0)) return;
  const Ray ray = place.leave(toEye);
  const Tracer::Joining joining(tracer);
  const Color passed = place.visible(tracer, ray, seen->distance, sampler.branch(Branch::land));
  if (!sample.thrown || isBlack(passed)) return;
  sample.thrown->push_back(
      {seen->place, factor * passed * place.clear(tracer, ray, seen->distance) * (perArea * counts), s});
}

}  // namespace trace
