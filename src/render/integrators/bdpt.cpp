#include "render/integrators/bdpt.h"

#include <algorithm>

#include "render/integrators/bdpt_paths.h"
#include "render/paths/subsurface.h"
#include "render/rays/firefly.h"
#include "render/world/footprint.h"
#include "shading/materials/subsurface.h"

namespace trace {

void Bidirectional::prepare(const World& world, const Settings& settings, Job&) {
  lamps_ = Lamps(world, settings.threads);
  starts_ = LightStarts(world, lamps_);
  camera_ = CameraImportance(world.camera());
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

/// The way that the sample's numbers choose: first how many places the path has, few more likely than many.
Bidirectional::Ways Bidirectional::waysOf(const Sampler& sampler) const {
  if (!multiplexed_) return ways_;
  const Vec2 u = sampler.branch(Branch::strategy).next2();
  const int most = depth_ + mostScattered_ + 3;  // places, both ends among them; the fewest are 2
  const auto likely = [](int places) { return 1.0 / places; };
  Real all = 0;
  for (int places = 2; places <= most; ++places) all += likely(places);
  Real rest = u.x * all;
  int places = 2;
  while (places < most && rest >= likely(places)) rest -= likely(places++);
  const int s = std::min(static_cast<int>(u.y * places), places - 1);
  return {s, places - s, all / likely(places) * places};
}

Bidirectional::Sample Bidirectional::sampleOf(const Sampler& sampler, std::vector<Thrown>* thrown) const {
  Sampler spectrum = sampler.branch(Branch::spectrum);
  Sample sample{spectrum.next(), spectrum.next(), waysOf(sampler)};
  sample.thrown = thrown;
  return sample;
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
  Path path;
  path.differentials = camera.differentials;
  path.ink = camera.ink;
  if (lands_) path.partial.vcm = Partial::power(1 / camera_.density(camera.ray));
  return along(tracer, camera.ray, camera.hit, path, camera.inside, sampler, sample);
}

/// The radiance along the ray, which is the one cast last and met `hit`; `inside` is what it was in there. In
/// media it may continue ten thousand times: no call for each.
Color Bidirectional::along(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
                           const Interfaces& inside, const Sampler& sampler, const Sample& sample) const {
  std::unique_ptr<Scattering> after;
  Color light = arrives(tracer, ray, hit, path, inside, sampler, sample, after);
  if (!after) return light;
  std::vector<std::unique_ptr<Scattering>> places;
  while (after) {
    const Scattering& from = *places.emplace_back(std::move(after));
    light = arrives(tracer, from.ray, from.hit, from.path, from.inside, from.sampler, sample, after);
  }
  for (; !places.empty(); places.pop_back()) {
    Scattering& at = *places.back();
    at.sum.add(at.factor * allowedPart(tracer, at.path.weight * light), light, at.how,
               ChanceTerm{at.density, 0, 1});
    at.sum.draw(at.ink);
    light = at.sum.radiance(at.passed);
  }
  return light;
}

/// The same up to where a medium scatters it to `after`.
Color Bidirectional::arrives(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, Path path,
                             const Interfaces& inside, const Sampler& sampler, const Sample& sample,
                             std::unique_ptr<Scattering>& after) const {
  const World& world = tracer.world();
  const int t = path.t();
  // A light that was asked, or comes by paths from it, is not seen besides.
  const bool brought = path.asked || path.fromLights;
  const auto lamp = brought || path.within ? std::nullopt : world.lampAlong(ray, hit ? hit->t : kInfinity);
  const Real end = lamp ? lamp->seen.t : hit ? hit->t : kInfinity;
  const bool mostOften = path.counts.scatterings > 0 && path.counts.scatterings >= mostScattered_;
  const bool onlyShines = path.counts.surfaces > depth_ || mostOften;  // is it sent for
  std::optional<MediumWay> media;
  if (isThick(tracer) && !path.within) {
    Sampler numbers = sampler.branch(Branch::medium);
    media = throughMedia(tracer, ray, end, inside, onlyShines ? 0 : 1, path.weight, numbers.branch(0));
    if (const auto where = placeByChance(*media, path.weight, numbers.next()))
      return scattered(tracer, ray, *media, *where, path, inside, sampler, sample, after);
    path.weight *= media->passes;
  }
  Gather sum(tracer, path.counts.all());
  const auto shines = [&] { return share(0, t, 0, sample); };  // what no other way finds
  const auto seeMedia = [&] {
    if (media) media->glows *= Color(shines());
    if (media) coverWithMedia(sum, *media);
    sum.draw(path.ink);
  };
  /// s = 0: the emitter there was met with the densities of being asked for and of having started there.
  const auto met = [&](Term::Kind kind, const Color& light, Real asked, Real started) {
    const Partial& p = path.partial;
    const Real others =
        path.kind == RayKind::camera ? 0 : Partial::power(asked) * p.vcm + Partial::power(started) * p.vc;
    const Real counts = share(0, t, others, sample);
    sum.addWay(kind, Color(counts), light, ConnectionTerm{0, t, counts});
  };
  if (lamp) {
    sum.addWay(Term::Kind::emissive, Color(shines()), lamp->seen.color, ConnectionTerm{0, t, shines()});
    sum.stop(MetLight{lamp->light, lamp->seen.t});
    seeMedia();
    return sum.radiance(inside.passed(lamp->seen.t));
  }
  if (!hit) {
    if (world.outside().isSeenBy(path.kind))  // parallel light starts no path in a medium
      met(Term::Kind::background, world.outside().view(ray, path.kind).color, lamps_.density(ray),
          path.fromMedium ? 0 : starts_.ofSky(ray.origin, ray.direction));
    seeMedia();
    return sum.radiance();
  }
  Footprint footprint;  // null where none is wanted
  if (path.differentials) footprint = arrivedAt(*hit, *path.differentials, ray.direction);
  Interaction at(tracer, ray, *hit, footprint.get(), inside, sample.shift);
  std::optional<SubsurfaceBsdf> body;
  if (path.within)
    at.letIn();
  else if (world.hasSubsurface())
    body = at.takeBody();
  sum.note(at.bsdf());
  sum.note(at.raised());
  sum.note(at.indices);
  const PathPlace place(at);
  const Real cosine = place.cosine(ray.direction), distance2 = hit->t * hit->t;
  path.partial.arrive(path.kind == RayKind::camera && camera_.parallel() ? 1 : distance2, cosine);

  if (!path.within && !isBlack(at.material.emissive))
    met(Term::Kind::emissive, at.material.emissive, lamps_.density(ray.origin, *hit) * cosine / distance2,
        starts_.ofLamp(*hit) * cosine);
  const auto throughMedium = [&] {
    seeMedia();
    return sum.radiance(path.within ? Color(1) : inside.passed(hit->t));
  };
  if (onlyShines) {
    sum.stop(DepthLimit{RayKind::bounce, mostOften ? mostScattered_ : depth_});
    return throughMedium();
  }
  joinAll(sum, place, path, path.counts + Counts{1, 0}, Color(1), sampler, sample);

  // Where light went in that comes out here is the same place of the path.
  const auto throughBody = [&](std::uint32_t n, Real part) {
    const Sampler own = sampler.branch(Branch::bdptBody).branch(n);
    const auto in = entrance(at, *body, path.weight, own.branch(0));
    if (!in) return;
    const Color factor = in->weight * part;
    Path onto{RayKind::refraction, path.counts, path.weight * factor};
    onto.within = true;
    sum.add(factor, along(tracer, in->ray, in->hit, onto, inside, own.branch(1), sample), in->how);
  };
  const bool both =
      body && path.counts.surfaces == 0;  // what is seen first is followed into the body besides
  const int places = both ? tracer.settings().subsurfaceSamples : 0;
  for (int n = 0; n < places; ++n) throughBody(static_cast<std::uint32_t>(n), 1.0 / places);
  std::optional<Real> intoBody;
  if (body) intoBody = both ? 0 : maxComponent(body->albedo) * maxComponent(body->passes(at.cosine));
  const Onward onward(at, sample.spectrum, intoBody);
  Sampler numbers = sampler.branch(Branch::choice);
  const Real choice = numbers.next();
  if (const Real likely = onward.goesIntoBody(choice); likely > 0) throughBody(0, 1 / likely);
  if (sample.ways.camera == t || onward.goesIntoBody(choice) > 0) return throughMedium();

  const auto next = onward.choose(choice, sampler.branch(Branch::lobe));
  if (!next) {
    if (onward.totallyReflected(choice)) sum.stop(TotalInternalReflection{});
    return throughMedium();
  }
  const bool splits = inside.wavelength == 0 && next->there.wavelength != 0;
  const Color weight = splits ? next->weight * onward.response() : next->weight;
  const Real most = maxComponent(path.weight * weight);
  const Real goes = path.counts.all() < kSurely ? 1 : std::min(1.0, most);
  if (path.counts.surfaces >= depth_ && next->kind != RayKind::bounce) {
    sum.stop(DepthLimit{next->kind, depth_});
  } else if (!(most > 0)) {
    sum.stop(BelowThreshold{next->kind, 0, 0});
  } else if (numbers.next() >= goes) {
    sum.stop(Roulette{next->kind, goes});
  } else {
    const Vec3 from = -ray.direction, to = next->direction;
    const bool bounces = next->kind == RayKind::bounce;
    Path onto{next->kind, path.counts + Counts{1, 0}, path.weight * weight * (1 / goes), path.partial};
    onto.fromLights = path.fromLights || (bounces && comesFromLights(path));
    onto.asked =
        bounces || (next->kind == RayKind::refraction && path.asked && tracer.lightPasses(at.bsdf()));
    Footprint widened;
    if (next->kind == RayKind::reflection)
      widened = mirroredAt(world, *hit, footprint.get(), ray.direction, at.normal);
    else if (next->kind == RayKind::refraction)
      widened = refractedAt(world, *hit, footprint.get(), ray.direction, to, at.normal, next->ratio);
    onto.differentials = widened.get();
    if (next->density > 0)
      onto.partial.leave(next->density, place.density(to, from), place.cosine(to));
    else
      onto.partial.reflect(place.cosine(to));
    const Ray leaving = bounces ? at.leaveToLight(to) : hit->leave(to);
    Interfaces there = next->there;
    const auto found = tracer.cast(leaving, next->kind, there, tracer.chance(sampler.branch(Branch::hole)));
    const Color arriving = along(tracer, leaving, found, onto, there, sampler.branch(Branch::next), sample);
    const Term::Kind term = bounces                             ? Term::Kind::bounce
                            : next->kind == RayKind::reflection ? Term::Kind::reflection
                                                                : Term::Kind::refraction;
    const Color factor = weight * (1 / goes);
    const Real part = bounces ? allowedPart(tracer, path.weight * factor * arriving) : 1;
    sum.add(term, factor * part, arriving, ChanceTerm{next->density, 0, 1});
  }
  return throughMedium();
}

/// The radiance along the ray where a medium on its way scatters light to it; unknown where it continues.
Color Bidirectional::scattered(Tracer& tracer, const Ray& ray, const MediumWay& way,
                               const MediumWay::Place& where, Path path, const Interfaces& inside,
                               const Sampler& sampler, const Sample& sample,
                               std::unique_ptr<Scattering>& after) const {
  after.reset(new Scattering{.sum = {tracer, path.counts.all()},
                             .how = {MediumTerm::What::follows, where.object, where.t, where.forward},
                             .passed = inside.passed(where.t),
                             .ink = path.ink,
                             .inside = inside,
                             .sampler = sampler.branch(Branch::next)});
  Gather& sum = after->sum;
  const auto radiance = [&] {
    sum.draw(path.ink);
    const Color light = sum.radiance(after->passed);
    after.reset();
    return light;
  };
  if (!isBlack(way.glows)) {
    const Real counts = share(0, path.t(), 0, sample);
    sum.add(Color(counts), way.glows, MediumTerm{MediumTerm::What::glows});
  }
  path.partial.arrive(path.kind == RayKind::camera && camera_.parallel() ? 1 : where.t * where.t, 1);
  const PathPlace place(ray, where, inside);
  const Counts counts = path.counts + Counts{0, 1};
  joinAll(sum, place, path, counts, where.weight, sampler, sample);
  if (sample.ways.camera == path.t()) return radiance();

  Sampler numbers = sampler.branch(Branch::choice);
  const Real most = maxComponent(path.weight * where.weight);
  const Real goes = path.counts.all() < kSurely ? 1 : std::min(1.0, most);
  if (!(most > 0) || !(numbers.next() < goes)) {
    sum.stop(Roulette{RayKind::bounce, goes});
    return radiance();
  }
  const auto [direction, density] =
      samplePhase(ray.direction, where.forward, sampler.branch(Branch::lobe).next2());
  after->factor = where.weight / goes;
  after->density = density;
  Path& onto = after->path;
  onto = {RayKind::bounce, counts, path.weight * after->factor, path.partial};
  onto.fromMedium = onto.asked = true;
  onto.fromLights = path.fromLights || comesFromLights(path);
  onto.partial.leave(density, density, 1);
  after->ray = {place.point(), direction};
  after->hit =
      tracer.cast(after->ray, RayKind::bounce, after->inside, tracer.chance(sampler.branch(Branch::hole)));
  return {};
}

}  // namespace trace
