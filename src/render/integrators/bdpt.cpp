#include "render/integrators/bdpt.h"

#include <algorithm>

#include "render/integrators/bdpt_paths.h"
#include "render/paths/arrival.h"

namespace trace {

void Bidirectional::prepare(const World& world, const Settings& settings, Job&) {
  lamps_ = Lamps(world, settings.threads);
  starts_ = LightStarts(world, lamps_);
  camera_ = CameraImportance(world.camera());
  splits_ = settings.wavelengths > 1;
  depth_ = settings.depth;
  mostScattered_ = settings.fog > 0 || !world.media().empty() ? settings.mediumDepth : 0;
  if (!multiplexed_) {
    ways_ = {settings.lightVertices, settings.cameraVertices, 1};
    weighs_ = !settings.unweighted;
  }
  lands_ = camera_.known() && !(settings.outlines > 0);
}

/// The MIS weight of a strategy whose others sum to `others`; 0 if the strategy is hidden.
Real Bidirectional::share(int s, int t, Real others, const Sample& sample) const {
  if (!sample.ways.shows(s, t)) return 0;
  return weighs_ ? sample.ways.counts / (1 + others) : 1;
}

/// Whether the path tracer would follow such a path from the camera to its end: on the last surface and at
/// the last place in a medium it only looks for emitters.
bool Bidirectional::allows(const Counts& whole, Last last) const {
  if (whole.surfaces > depth_ + 1 || (whole.surfaces == depth_ + 1 && last != Last::lobe)) return false;
  if (whole.scatterings == 0) return true;
  return whole.scatterings < mostScattered_ || (whole.scatterings == mostScattered_ && last == Last::medium);
}

/// Whether paths from lights bring to a place that scatters what it gets by mirrors and glass: they land
/// there, if the camera sees it straight, or are joined with the place before it, if that scatters, too.
bool Bidirectional::comesFromLights(const Path& path) const {
  return starts_.anyLight() && (path.kind == RayKind::bounce || (lands_ && path.kind == RayKind::camera));
}

Bidirectional::Sample Bidirectional::sampleOf(const Sampler& sampler, std::vector<Thrown>* thrown) const {
  Sampler spectrum = sampler.branch(Branch::spectrum);
  const auto number = [&] { return splits_ ? spectrum.next() : 0; };
  const int most = depth_ + mostScattered_ + 3;  // vertices of a path
  const auto chosen = [&] { return Strategies::chosen(most, sampler.branch(Branch::strategy).next2()); };
  return {number(), number(), multiplexed_ ? chosen() : ways_, thrown};
}

void Bidirectional::throwLight(Tracer& tracer, const Sampler& sampler, std::vector<Thrown>& thrown) const {
  Sample sample = sampleOf(sampler, &thrown);
  if (!lands_ || (sample.ways.camera >= 0 && sample.ways.camera != 1)) return;
  walkFromLight(tracer, sampler.branch(Branch::lightPath), sample);
}

Color Bidirectional::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Sample sample = sampleOf(sampler, camera.thrown);
  walkFromLight(tracer, sampler.branch(Branch::lightPath), sample);
  if (sample.ways.camera == 1) return Gather(tracer, 0).radiance();
  Path path{{camera, sampler}};
  if (lands_) path.partial.vcm = PartialSums::power(1 / camera_.density(camera.ray));
  return along(tracer, path, camera.hit, sample);
}

/// The radiance along the ray of the path, which was cast last and ends at `hit`.
Color Bidirectional::along(Tracer& tracer, Path& path, const std::optional<Hit>& hit,
                           const Sample& sample) const {
  return walk(tracer, path, hit, [&](const std::optional<Hit>& met, Turns& turns) {
    return arrive(tracer, path, met, turns, sample);
  });
}

/// Joins the place where the path arrives with all others, and turns the path; or ends it.
std::optional<Color> Bidirectional::arrive(Tracer& tracer, Path& path, const std::optional<Hit>& hit,
                                           Turns& turns, const Sample& sample) const {
  const World& world = tracer.world();
  const Ray& ray = path.ray;
  const int t = path.t();
  // A light that was asked, or comes by paths from it, is not seen besides.
  const bool brought = path.asked || path.fromLights;
  const LegEnd end(world, path, hit, !brought);
  const bool mostOften = path.counts.scatterings > 0 && path.counts.scatterings >= mostScattered_;
  const bool last = path.counts.surfaces > depth_ || mostOften;  // it looks for emitters only
  const auto shines = [&] { return share(0, t, 0, sample); };    // what no other way finds
  LegMedia media(tracer, path, end.t, last ? 0 : 1);
  if (media.place) return scatter(tracer, path, media, turns, sample);
  if (media.way) {
    path.weight *= media.way->passes;
    media.way->glows *= Color(shines());
  }
  Turn& turn = pushArrived(turns, tracer, path.counts.all(), path, media, end.t);
  Gather& sum = turn.sum;
  /// s = 0: the emitter there was hit with the densities of being asked for and of having started there.
  const auto met = [&](Term::Kind kind, const Color& light, Real asked, Real started) {
    const auto& [vcm, vc] = path.partial;
    const Real others =
        path.kind == RayKind::camera ? 0 : PartialSums::power(asked) * vcm + PartialSums::power(started) * vc;
    const Real counts = share(0, t, others, sample);
    sum.addWay(kind, Color(counts), light, ConnectionTerm{0, t, counts});
  };
  if (end.lamp) {
    const World::Lamp& lamp = *end.lamp;
    sum.addWay(Term::Kind::emissive, Color(shines()), lamp.seen.color, ConnectionTerm{0, t, shines()});
    sum.stop(MetLight{lamp.light, lamp.seen.t});
    return turns.end();
  }
  if (!hit) {
    if (world.outside().isSeenBy(path.kind))  // parallel light starts no path in a medium
      met(Term::Kind::background, world.outside().view(ray, path.kind).color, lamps_.density(ray),
          path.fromMedium ? 0 : starts_.ofSky(ray.origin, ray.direction));
    return turns.end();
  }
  const Arrival arrival(tracer, path, *hit, turn, sample.shift);
  const Interaction& at = arrival.at;
  const PathPlace place(at);
  const Real cosine = place.cosine(ray.direction), distance2 = hit->t * hit->t;
  path.partial.arrive(path.kind == RayKind::camera && camera_.parallel() ? 1 : distance2, cosine);

  if (!path.within && !isBlack(at.material.emissive))
    met(Term::Kind::emissive, at.material.emissive, lamps_.density(ray.origin, *hit) * cosine / distance2,
        starts_.ofLamp(*hit) * cosine);
  if (last) {
    sum.stop(DepthLimit{RayKind::bounce, mostOften ? mostScattered_ : depth_});
    return turns.end();
  }
  const Counts counts = path.counts + Counts{1, 0};
  joinAll(sum, place, path, counts, Color(1), sample);

  // Where light went in that comes out here is the same place of the path.
  const auto within = [&](const Leg& leg, const Hit& entered) {
    Path inner{leg, path.counts};
    return along(tracer, inner, entered, sample);
  };
  const BodyLight body(sum, arrival, path, Branch::bdptBody, within);
  const Onward onward(at, sample.spectrum, body.addFirst(path.counts.surfaces == 0));
  Sampler numbers = path.numbers.branch(Branch::choice);
  const Real choice = onward.choice(numbers);
  if (body.takes(onward, choice)) return turns.end();
  if (sample.ways.camera == t) return turns.end();

  const auto next =
      onward.choose(choice, lobeNumbers(path.numbers.branch(Branch::lobe), hasOneLobe(at.bsdf())));
  if (!next) {
    if (onward.totallyReflected(choice)) sum.stop(TotalInternalReflection{});
    return turns.end();
  }
  const RayKind kind = next->kind;
  const bool bounces = kind == RayKind::bounce;
  const Color weight = onward.seen(*next);
  const Real most = maxComponent(path.weight * weight), goes = counts.keeps(most);
  const bool deep = path.counts.surfaces >= depth_ && !bounces;
  if (!continues(sum, kind, deep ? std::optional(depth_) : std::nullopt, most > 0, goes,
                 [&] { return numbers.next(); }))
    return turns.end();
  turn.density = next->density;
  path.fromLights = path.fromLights || (bounces && comesFromLights(path));
  path.partial.leave(place, *next, -ray.direction);
  path.counts = counts;
  path.fromMedium = false;
  goOn(path, turn, at, arrival.footprint.get(), *next, weight * (1 / goes));
  return {};
}

/// Joins and turns the path where a medium on the way scatters it.
std::optional<Color> Bidirectional::scatter(Tracer& tracer, Path& path, const LegMedia& media, Turns& turns,
                                            const Sample& sample) const {
  const MediumWay::Place& where = *media.place;
  Turn& turn = pushScattered(turns, tracer, path.counts.all(), path, media, share(0, path.t(), 0, sample));
  path.partial.arrive(path.kind == RayKind::camera && camera_.parallel() ? 1 : where.t * where.t, 1);
  const PathPlace place(path.ray, where, path.inside);
  const Counts counts = path.counts + Counts{0, 1};
  joinAll(turn.sum, place, path, counts, where.weight, sample);
  if (sample.ways.camera == path.t()) return turns.end();

  Sampler numbers = path.numbers.branch(Branch::choice);
  const Real most = maxComponent(path.weight * where.weight), goes = counts.keeps(most);
  if (!(most > 0) || !(numbers.next() < goes)) {
    turn.sum.stop(Roulette{RayKind::bounce, goes});
    return turns.end();
  }
  path.fromLights = path.fromLights || comesFromLights(path);
  path.fromMedium = true;
  goOn(path, turn, where, goes, path.numbers.branch(Branch::lobe).next2());
  path.partial.leave(turn.density, turn.density, 1);
  path.counts = counts;
  return {};
}

}  // namespace trace
