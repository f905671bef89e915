#include "render/integrators/path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/paths/onward.h"
#include "render/paths/subsurface.h"
#include "shading/materials/subsurface.h"

namespace trace {

void PathTracer::prepare(const World& world, const Settings& settings, Job&) {
  lamps_ = Lamps(world, settings.threads);
  depth_ = bounces_ ? settings.depth : 0;
  mostScattered_ = bounces_ ? settings.mediumDepth : 1;
}

Color PathTracer::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Path path{{camera.ray, camera.inside, sampler}};
  if (camera.differentials) path.footprint = *camera.differentials;
  path.ink = camera.ink;
  if (terminator_) path.told = terminator_->begin(sampler.sample());
  return along(tracer, path, camera.hit);
}

Color PathTracer::along(Tracer& tracer, Path& path, const std::optional<Hit>& hit) const {
  return walk(tracer, path, hit,
              [&](const std::optional<Hit>& met, Turns& turns) { return arrive(tracer, path, met, turns); });
}

/// Gathers the light of the place where the path arrives, and turns it; or ends it.
std::optional<Color> PathTracer::arrive(Tracer& tracer, Path& path, const std::optional<Hit>& hit,
                                        Turns& turns) const {
  const World& world = tracer.world();
  const Ray& ray = path.ray;
  const bool known = terminator_ && !(path.density > 0) && terminator_->knowsEmitter(path.told, path.kind);
  const auto lamp =
      path.asked || path.within || known ? std::nullopt : world.lampAlong(ray, hit ? hit->t : kInfinity);
  const Real end = lamp ? lamp->seen.t : hit ? hit->t : kInfinity;
  const bool last = path.depth > depth_ || path.scattered >= mostScattered_;  // it looks for emitters only
  std::optional<MediumWay> media;
  if (isThick(tracer) && !path.within) {
    Sampler numbers = path.numbers.branch(Branch::medium);
    media = throughMedia(tracer, ray, end, path.inside, last || path.told.all ? 0 : 1, path.weight,
                         numbers.branch(0));
    if (const auto place = placeByChance(*media, path.weight, numbers.next()))
      return scatter(tracer, path, *media, *place, turns);
  }
  Turn& turn = turns.push(tracer, path.depth, path.ink);
  turn.media = std::move(media);
  Gather& sum = turn.sum;
  if (lamp) {
    turn.passed = path.inside.passed(end);
    sum.add(*lamp);
    return turns.end();
  }
  if (!hit) {
    if (world.outside().isSeenBy(path.kind) && !known) {
      const Ray whole{path.from, ray.direction};
      const ChanceTerm met = weighed(path.density, path.density > 0 ? lamps_.density(whole) : 0);
      sum.add(Term::Kind::background, Color(met.share), world.outside().view(ray, path.kind).color, met);
    }
    return turns.end();
  }
  if (!path.within) turn.passed = path.inside.passed(end);
  Footprint footprint;
  if (const Differentials* differentials = path.footprint.get())
    footprint = arrivedAt(*hit, *differentials, ray.direction);
  // Numbers are drawn where something is to be chosen: which ray is followed, and which wavelength.
  const bool splits = tracer.settings().wavelengths > 1;
  Vec2 choice = splits ? path.numbers.branch(Branch::choice).next2() : Vec2{};
  // One number chooses where all wavelengths lie, and which of them: the two must not depend on each other.
  const Real wavelength = choice.y * tracer.settings().wavelengths;
  Interaction at(tracer, ray, *hit, footprint.get(), path.inside, wavelength - std::floor(wavelength));
  std::unique_ptr<const SubsurfaceBsdf> body;
  if (path.within)
    at.letIn();
  else if (world.hasSubsurface())
    body = at.takeBody();
  sum.note(at.bsdf());
  sum.note(at.raised());
  sum.note(at.indices);

  // Le, which a place on the lamp finds as well.
  if (!known && !path.within) {
    const ChanceTerm met = weighed(path.density, path.density > 0 ? lamps_.density(path.from, *hit) : 0);
    sum.add(Term::Kind::emissive, Color(met.share), at.material.emissive, met);
  }
  const bool pane = meetsBehind(path, at);
  if (last) {
    if (const auto behind = pane ? Onward(at, choice.y).only(RayKind::refraction) : std::nullopt) {
      follow(path, turn, at, footprint.get(), *behind, behind->weight);
      return {};
    }
    sum.stop(DepthLimit{RayKind::bounce, path.depth > depth_ ? depth_ : mostScattered_});
    return turns.end();
  }

  // The lights, and what need not be traced.
  Terminator::Left left;
  if (terminator_)
    left = terminator_->addLight(sum, at, path.told, path.kind, path.numbers);
  else if (!world.lights().empty())
    at.addLights(sum, path.numbers);

  // Where light goes in that comes out here: several places behind the camera ray, else perhaps one.
  const auto throughBody = [&](std::uint32_t n, Real part) {
    const Sampler own = path.numbers.branch(Branch::pathBody).branch(n);
    const auto in = entrance(at, *body, path.weight, own.branch(0));
    if (!in) return;
    const Color factor = in->weight * part;
    Path within{{in->ray, path.inside, own.branch(1), RayKind::refraction}};
    within.depth = path.depth, within.scattered = path.scattered;
    within.weight = path.weight * factor;
    within.within = true;
    within.told = left.here;
    sum.add(factor, along(tracer, within, in->hit), in->how);
  };
  std::optional<Real> intoBody;
  if (body) {
    const bool many = path.depth == 0;
    const int places = many ? tracer.settings().subsurfaceSamples : 0;
    for (int n = 0; n < places; ++n) throughBody(static_cast<std::uint32_t>(n), 1.0 / places);
    intoBody = many || !left.body ? 0 : maxComponent(body->albedo) * maxComponent(body->passes(at.cosine));
  }

  // The lamp, and the ray that is followed.
  const Onward onward(at, choice.y, intoBody, left.lobe);
  const Real toLobe = onward.chance(RayKind::bounce);
  if (!splits && toLobe < 1) choice.x = path.numbers.branch(Branch::choice).next();
  if (left.lamps && scatters(at.bsdf())) addLamp(sum, at, toLobe, path.numbers);
  if (const Real likely = onward.goesIntoBody(choice.x); likely > 0) {
    throughBody(0, 1 / likely);
    return turns.end();
  }
  const auto next = onward.choose(choice.x, [&] {
    const Real which = hasOneLobe(at.bsdf()) ? 0 : path.numbers.branch(Branch::lobe).next();
    return LobeNumbers{which, path.numbers.branch(Branch::next).branch(Branch::arrival).next2()};
  });
  if (!next) {
    if (onward.totallyReflected(choice.x)) sum.stop(TotalInternalReflection{});
    return turns.end();
  }
  const RayKind kind = next->kind;
  const bool crosses = pane && kind == RayKind::refraction;
  const Color weight = kind == RayKind::refraction ? next->weight * onward.response() : next->weight;
  const Real goes = survival(path.depth, path.weight * weight);
  if (path.depth >= depth_ && kind != RayKind::bounce && !crosses) {
    sum.stop(DepthLimit{kind, depth_});
  } else if (!(goes > 0) || !(crosses || left.brings(kind))) {
    sum.stop(BelowThreshold{kind, 0, 0});
  } else if (goes < 1 && path.numbers.branch(Branch::roulette).next() >= goes) {
    sum.stop(Roulette{kind, goes});
  } else {
    turn.density = next->density * toLobe;
    if (terminator_) path.told = Terminator::onward(path.told, left, kind);
    follow(path, turn, at, footprint.get(), *next, weight * (1 / goes));
    return {};
  }
  return turns.end();
}

/// The path continues with that ray, whose light the turn counts by `factor`.
void PathTracer::follow(Path& path, Turn& turn, const Interaction& at, const Differentials* arrived,
                        const Onward::Ray& next, const Color& factor) const {
  const bool through = next.kind == RayKind::refraction, crosses = through && meetsBehind(path, at);
  turn.factor = factor;
  turn.weight = path.weight = path.weight * factor;
  path.asked = next.kind == RayKind::bounce || (through && path.asked && at.tracer.lightPasses(at.bsdf()));
  path.within = false;
  ++path.depth;
  if (!crosses)
    path.density = turn.density;
  else if (!at.tracer.world().castsShadow(at.hit))  // its light was sampled whole: none is left to meet
    path.density = std::numeric_limits<Real>::min();
  goOn(path, turn, at, arrived, next);
  if (!crosses) path.from = path.ray.origin;
}

/// Gathers and turns the path where a medium on the way scatters it.
std::optional<Color> PathTracer::scatter(Tracer& tracer, Path& path, const MediumWay& way,
                                         const MediumWay::Place& place, Turns& turns) const {
  Turn& turn = turns.push(tracer, path.depth, path.ink);
  turn.passed = path.inside.passed(place.t);
  Gather& sum = turn.sum;
  const MediumTerm term{MediumTerm::What::scatters, place.object, place.t, place.forward};
  if (!isBlack(way.glows)) sum.add(Color(1), way.glows, MediumTerm{MediumTerm::What::glows});
  const ScatterPlace at{path.ray, path.ray.at(place.t), place.weight, place.forward, path.inside, term};
  const Sampler numbers = path.numbers.branch(Branch::medium).branch(1);
  addLightsAt(sum, tracer, at, numbers);
  addLampAt(sum, tracer, at, lamps_, true, numbers);
  if (terminator_) terminator_->addInMedium(sum, at, path.told, path.numbers);

  Sampler lobe = path.numbers.branch(Branch::lobe);
  const Real goes = survival(path.depth + path.scattered, path.weight * place.weight);
  if (!(lobe.next() < goes)) {
    sum.stop(Roulette{RayKind::bounce, goes});
    return turns.end();
  }
  const auto [direction, density] = samplePhase(path.ray.direction, place.forward, lobe.next2());
  turn.factor = place.weight / goes;
  turn.weight = path.weight * turn.factor;
  turn.density = density;
  turn.scatters = MediumTerm{MediumTerm::What::follows, place.object, place.t, place.forward};
  const Terminator::Told& told = path.told;
  path.told = {told.maps, told.gathers};
  ++path.scattered;
  path.weight = turn.weight;
  path.density = density;
  path.from = at.point;
  path.asked = true;
  path.kind = RayKind::bounce;
  path.footprint = {};
  path.ink = 0;
  path.ray = {at.point, direction};
  return {};
}

/// The light of one place on an emissive object; `shareOfLobe` is how often a ray into the lobe is
/// followed.
void PathTracer::addLamp(Gather& sum, const Interaction& at, Real shareOfLobe, const Sampler& numbers) const {
  if (lamps_.empty()) return;
  Sampler own = numbers.branch(Branch::lamp);
  // The second pair of the numbers that led here: what depends on both is spread evenly, too.
  const Vec2 where = numbers.branch(Branch::arrival).second2();
  const Real which = lamps_.isOne() ? 0 : own.next();
  auto place = lamps_.choose(at.lightPlace(), which, where);
  if (!place) return;
  const Vec3 toEye = -at.ray.direction;
  const Color scattered =
      evaluate(at.bsdf(), at.frame, toEye, place->toLight, Transport::importance) * (1 - at.coat);
  const bool inward = dot(place->toLight, at.normal) < 0;
  if (isBlack(scattered) || (!inward && at.isAstray(place->toLight))) return;
  const Real other = shareOfLobe * density(at.bsdf(), at.frame, toEye, place->toLight);
  ChanceTerm chance = weighed(place->density, other);
  const Ray toLamp = at.leaveToLight(place->toLight);
  const Real hole = at.tracer.chance(own);
  const Color seen = inward && at.transmits ? lamps_.look(at.tracer, toLamp, *place, at.behind(), hole)
                                            : lamps_.look(at.tracer, toLamp, *place, at.inside, hole);
  if (at.tracer.passedShadowless()) chance = weighed(place->density, 0);
  Color factor = scattered * (chance.share / place->density);
  if (!at.tracer.world().media().empty() && !isBlack(seen))
    factor *= passedByBodies(at.tracer, toLamp, place->distance, numbers.branch(Branch::pathToLamp));
  sum.add(Term::Kind::lamp, factor, seen, chance);
}

}  // namespace trace
