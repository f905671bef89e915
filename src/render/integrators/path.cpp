#include "render/integrators/path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/media/lamp_light.h"
#include "render/paths/even_point.h"

namespace trace {

void PathTracer::prepare(const World& world, const Settings& settings, Job&) {
  lamps_ = Lamps(world, settings.threads);
  depth_ = bounces_ ? settings.depth : 0;
  mostScattered_ = bounces_ ? settings.mediumDepth : 1;
  knowsEvenPoints_ = !settings.varnish && !settings.smoothTerminator;
}

Color PathTracer::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Path path{{camera, sampler}};
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
  const LegEnd end(world, path, hit, !path.asked && !known);
  const bool last = path.depth > depth_ || path.scattered >= mostScattered_;  // it looks for emitters only
  LegMedia media(tracer, path, end.t, last || path.told.all ? 0 : 1);
  if (media.place) return scatter(tracer, path, media, turns);
  Turn& turn = pushArrived(turns, tracer, path.depth, path, media, end.t);
  if (end.lamp) {
    turn.sum.add(*end.lamp);
    return turns.end();
  }
  if (!hit) {
    if (world.outside().isSeenBy(path.kind) && !known) {
      const Ray whole{path.from, ray.direction};
      const ChanceTerm met = weighed(path.density, path.density > 0 ? lamps_.density(whole) : 0);
      turn.sum.add(Term::Kind::background, Color(met.share), world.outside().view(ray, path.kind).color, met);
    }
    return turns.end();
  }
  const bool tries = knowsEvenPoints_ && !terminator_ && !path.within && !tracer.records();
  if (const PhongBsdf* even = tries ? EvenPoint::bsdfOf(world, *hit) : nullptr)
    return turnEvenly(tracer, path, *hit, *even, last, turns);
  return turnAt(tracer, path, *hit, known, last, turns);
}

/// Le, which light sampling finds as well.
void PathTracer::addEmission(Gather& sum, const Path& path, const Hit& hit, const Color& emissive) const {
  const ChanceTerm met = weighed(path.density, path.density > 0 ? lamps_.density(path.from, hit) : 0);
  sum.add(Term::Kind::emissive, Color(met.share), emissive, met);
}

template <class Point>
void PathTracer::addLamp(Gather& sum, const Point& at, Real shareOfLobe, const Path& path) const {
  if (lamps_.empty()) return;
  const Sampler& numbers = path.numbers;
  Sampler own = numbers.branch(Branch::lamp);
  const Real which = lamps_.isOne() ? 0 : own.next();
  // The second pair of the numbers that led here: what depends on both is spread evenly, too.
  const Vec2 where = path.second ? *path.second : numbers.branch(Branch::arrival).second2();
  askLamp(
      sum, lamps_, at, {which, where}, [&] { return own.next(); },
      [&] { return numbers.branch(Branch::pathToLamp); },
      [&](const Lamps::Place& place, bool alone) {
        const Color scattered = at.scattered(place.toLight);
        if (isBlack(scattered)) return LampWeight<ChanceTerm>{};
        const Real other = alone ? 0 : shareOfLobe * at.density(place.toLight);
        const ChanceTerm chance = weighed(place.density, other);
        return LampWeight<ChanceTerm>{scattered * (chance.share / place.density), chance};
      });
}

/// A surface of any kind.
std::optional<Color> PathTracer::turnAt(Tracer& tracer, Path& path, const Hit& hit, bool known, bool last,
                                        Turns& turns) const {
  Turn& turn = turns.top();
  Gather& sum = turn.sum;
  // Numbers are drawn where something is to be chosen: which ray is followed, and which wavelength.
  const bool splits = tracer.settings().wavelengths > 1;
  Vec2 choice = splits ? path.numbers.branch(Branch::choice).next2() : Vec2{};
  // One number chooses where all wavelengths lie, and which of them: the two must not depend on each other.
  const Real wavelength = choice.y * tracer.settings().wavelengths;
  const Arrival arrival(tracer, path, hit, turn, wavelength - std::floor(wavelength));
  const Interaction& at = arrival.at;
  if (!known && !path.within) addEmission(sum, path, hit, at.material.emissive);
  const bool pane = meetsBehind(path, at);
  if (last) {
    if (const auto behind = pane ? Onward(at, choice.y).only(RayKind::refraction) : std::nullopt) {
      follow(path, turn, arrival, *behind, behind->weight);
      return {};
    }
    sum.stop(DepthLimit{RayKind::bounce, path.depth > depth_ ? depth_ : mostScattered_});
    return turns.end();
  }

  // The lights, and what need not be traced.
  Terminator::Left left;
  if (terminator_)
    left = terminator_->addLight(sum, at, path.told, path.kind, path.numbers);
  else if (!tracer.world().lights().empty())
    at.addLights(sum, path.numbers);

  // The lamp, and the ray that is followed.
  const auto within = [&](const Leg& leg, const Hit& met) {
    Path inner{leg, path.depth, path.scattered, 0, {}, left.here};
    return along(tracer, inner, met);
  };
  const BodyLight body(sum, arrival, path, Branch::pathBody, within);
  std::optional<Real> intoBody = body.addFirst(path.depth == 0);
  if (intoBody && !left.body) intoBody = 0;
  const Onward onward(at, choice.y, intoBody, left.lobe);
  const Real toLobe = onward.chance(RayKind::bounce);
  if (!splits && toLobe < 1) choice.x = path.numbers.branch(Branch::choice).next();
  if (left.lamps && scatters(at.bsdf())) addLamp(sum, at, toLobe, path);
  if (body.takes(onward, choice.x)) return turns.end();
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
  const Color weight = onward.seen(*next);
  const Real goes = survival(path.depth, path.weight * weight);
  const bool deep = path.depth >= depth_ && kind != RayKind::bounce && !crosses;
  const bool brings = goes > 0 && (crosses || left.brings(kind));
  if (!continues(sum, kind, deep ? std::optional(depth_) : std::nullopt, brings, goes, path.roulette()))
    return turns.end();
  turn.density = next->density * toLobe;
  if (terminator_) path.told = Terminator::onward(path.told, left, kind);
  follow(path, turn, arrival, *next, weight * (1 / goes));
  return {};
}

/// A surface that only scatters evenly: to the same bits as above, where rays are not recorded.
std::optional<Color> PathTracer::turnEvenly(Tracer& tracer, Path& path, const Hit& hit, const PhongBsdf& bsdf,
                                            bool last, Turns& turns) const {
  Turn& turn = turns.top();
  if (!isBlack(bsdf.emissive)) addEmission(turn.sum, path, hit, bsdf.emissive);
  if (last) return turns.end();
  const bool lit = !tracer.world().lights().empty();
  if (lit) Interaction(tracer, path.ray, hit, nullptr, path.inside, 0).addLights(turn.sum, path.numbers);
  if (!bsdf.scatters()) return turns.end();
  const EvenPoint at(path.ray, hit, bsdf, path.inside);
  addLamp(turn.sum, at, 1, path);

  const Real goes = survival(path.depth, path.weight * bsdf.diffuse);
  if (!(goes > 0) || (goes < 1 && !(path.roulette()() < goes))) return turns.end();
  path.second.reset();
  const auto next = at.sample(path.numbers.branch(Branch::next).branch(Branch::arrival).next2(path.second));
  if (!next) return turns.end();
  bounce(path, turn, at.leave(next->direction), bsdf.diffuse * (1 / goes), next->density);
  ++path.depth;
  path.density = next->density;
  path.from = path.ray.origin;
  return {};
}

/// The path continues with that ray, whose light the turn counts by `factor`.
void PathTracer::follow(Path& path, Turn& turn, const Arrival& arrival, const Onward::Ray& next,
                        const Color& factor) {
  const Interaction& at = arrival.at;
  const bool crosses = next.kind == RayKind::refraction && meetsBehind(path, at);
  ++path.depth;
  path.second.reset();
  if (!crosses)
    path.density = turn.density;
  else if (!at.tracer.world().castsShadow(at.hit))  // its light was sampled whole: none is left to meet
    path.density = std::numeric_limits<Real>::min();
  goOn(path, turn, at, arrival.footprint.get(), next, factor);
  if (!crosses) path.from = path.ray.origin;
}

/// Gathers and turns the path where a medium on the way scatters it.
std::optional<Color> PathTracer::scatter(Tracer& tracer, Path& path, const LegMedia& media,
                                         Turns& turns) const {
  const MediumWay::Place& place = *media.place;
  Turn& turn = pushScattered(turns, tracer, path.depth, path, media);
  const MediumTerm term{MediumTerm::What::scatters, place.object, place.t, place.forward};
  const ScatterPlace at{path.ray, path.ray.at(place.t), place.weight, place.forward, path.inside, term};
  const Sampler numbers = path.numbers.branch(Branch::medium).branch(1);
  addLightsAt(turn.sum, tracer, at, numbers);
  addLampAt(turn.sum, at, lamps_, true, numbers);
  if (terminator_) terminator_->addInMedium(turn.sum, at, path.told, path.numbers);

  Sampler lobe = path.numbers.branch(Branch::lobe);
  const Real goes = survival(path.depth + path.scattered, path.weight * place.weight);
  if (!(lobe.next() < goes)) {
    turn.sum.stop(Roulette{RayKind::bounce, goes});
    return turns.end();
  }
  goOn(path, turn, place, goes, lobe.next2());
  path.told = {path.told.maps, path.told.gathers};
  ++path.scattered;
  path.second.reset();
  path.density = turn.density;
  path.from = at.point();
  return {};
}

}  // namespace trace
