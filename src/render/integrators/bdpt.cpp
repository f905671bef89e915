#include "render/integrators/bdpt.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "render/fog.h"
#include "render/footprint.h"
#include "render/interaction.h"
#include "render/media.h"
#include "render/onward.h"

namespace trace {

/// The partial sums of one end's path, whose heuristic is this power of the densities.
struct Partial {
  static Real power(Real density) { return density * density; }

  Real vcm = 0, vc = 0;

  /// The path has arrived: its density was over solid angle, and is over area now.
  void arrive(Real distance2, Real cosine) {
    const Real c = 1 / power(cosine);
    vcm *= power(distance2) * c;
    vc *= c;
  }
  /// It goes on: in a direction of a lobe with that density, which the other way round is `reverse`; at
  /// `cosine` to the surface.
  void leave(Real density, Real reverse, Real cosine) {
    vc = power(cosine / density) * (vc * power(reverse) + vcm);
    vcm = power(1 / density);
  }
  /// In the only direction of a mirror or of glass, where nothing is joined.
  void reflect(Real cosine) {
    vc *= power(cosine);
    vcm = 0;
  }
  /// What all other ways that start on this end count, where the other end comes upon the place with that
  /// density, and the place sends its path back with `reverse`.
  Real others(Real density, Real reverse) const { return power(density) * (vcm + vc * power(reverse)); }
};

/// Where a path from the camera is.
struct Bidirectional::Path {
  RayKind kind = RayKind::camera;
  int depth = 0;    ///< bounces; t is 2 more
  Color weight{1};  ///< of the ray's radiance in the sample
  Partial partial;
  const Differentials* differentials = nullptr;  ///< of the ray, if they are wanted
  Real ink = 0;                                  ///< how much of it an outline covers
};

/// Of a path from a light.
struct Bidirectional::Place {
  Place(Tracer& tracer, const Ray& ray_, Interfaces inside_, const Hit& hit_, Real choice)
      : ray(ray_), inside(std::move(inside_)), hit(hit_), at(tracer, ray, hit, nullptr, inside, choice) {}

  Ray ray;
  Interfaces inside;
  Hit hit;
  Interaction at;
  Color power;        ///< what arrives, over the density of the place and its cosine
  Color response{1};  ///< of the wavelength, if the path was split: not in the power
  Partial partial;
  bool lit = false;       ///< by a light of the world, straight
  bool straight = false;  ///< the path met a mirror or glass right after its start
};

/// What both paths of a sample know.
struct Bidirectional::Sample {
  Real spectrum;  ///< chooses the wavelength, should a path be split
  Real shift;     ///< of all wavelengths to choose from
  Ways ways;
  std::deque<Place> lights{};
  std::vector<Thrown>* thrown = nullptr;
};

namespace {

/// Branches of a sample's numbers, and of a place's: its lights by their number, and these.
constexpr std::uint32_t kLamp = 0x80000000u, kChoice = 0x80000001u, kLobe = 0x80000002u, kNext = 0x80000003u,
                        kFog = 0x80000004u, kHole = 0x80000005u, kLightPath = 0x80000006u,
                        kSpectrum = 0x80000007u, kLens = 0x80000008u, kWay = 0x80000009u;
/// Paths of fewer bounces are not ended by chance.
constexpr int kSurely = 3;

Real cosineAt(const Hit& hit, const Vec3& direction) { return std::abs(dot(direction, hit.surface.normal)); }

/// What passes of light along so much of a ray, if nothing is in the way: the body's share and the fog's.
Color passesOf(Tracer& tracer, const Ray& ray, Real distance, const Interfaces& inside) {
  const Fog fog(tracer.settings());
  const Color passed = inside.passed(distance);
  if (fog.none() || !isInOpenAir(inside, tracer.world())) return passed;
  return passed * fog.passes(ray, distance);
}

/// What a ray is in that leaves the place toward light.
Interfaces sideOf(const Interaction& at, const Vec3& direction) {
  return dot(direction, at.normal) < 0 && at.transmits ? at.behind() : at.inside;
}

}  // namespace

void Bidirectional::prepare(const World& world, const Settings& settings, Job&) {
  lamps_ = Lamps(world, settings.threads);
  starts_ = LightStarts(world, lamps_);
  camera_ = CameraImportance(world.camera());
  depth_ = settings.depth;
  if (!multiplexed_) {
    ways_ = {settings.lightVertices, settings.cameraVertices, 1};
    weighs_ = !settings.unweighted;
  }
  lands_ = camera_.known() && !(settings.outlines > 0);
}

/// What the way counts whose others count so much beside it; 0 if it is not to be shown.
Real Bidirectional::share(int s, int t, Real others, const Sample& sample) const {
  if (!sample.ways.shows(s, t)) return 0;
  return weighs_ ? sample.ways.counts / (1 + others) : 1;
}

/// The way that the sample's numbers choose: first how many places the path has, few more likely than many.
Bidirectional::Ways Bidirectional::waysOf(const Sampler& sampler) const {
  if (!multiplexed_) return ways_;
  const Vec2 u = sampler.branch(kWay).next2();
  const int most = depth_ + 3;  // places, both ends among them; the fewest are 2
  const auto likely = [](int places) { return 1.0 / places; };
  Real all = 0;
  for (int places = 2; places <= most; ++places) all += likely(places);
  Real rest = u.x * all;
  int places = 2;
  while (places < most && rest >= likely(places)) rest -= likely(places++);
  const int s = std::min(static_cast<int>(u.y * places), places - 1);
  return {s, places - s, all / likely(places) * places};
}

Color Bidirectional::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Sampler spectrum = sampler.branch(kSpectrum);
  Sample sample{spectrum.next(), spectrum.next(), waysOf(sampler)};
  sample.thrown = camera.thrown;
  walkFromLight(tracer, sampler.branch(kLightPath), sample);
  if (sample.ways.camera == 1) return Gather(tracer, 0).radiance();
  Path path;
  path.differentials = camera.differentials;
  path.ink = camera.ink;
  if (lands_) path.partial.vcm = Partial::power(1 / camera_.density(camera.ray));
  return along(tracer, camera.ray, camera.hit, path, camera.inside, sampler, sample);
}

/// Keeps the places of a path from a light, and lets those land that the camera sees.
void Bidirectional::walkFromLight(Tracer& tracer, const Sampler& sampler, Sample& sample) const {
  const Ways& ways = sample.ways;
  if (ways.light == 0 || ways.light == 1) return;
  Tracer::Aside aside(tracer);
  auto start = starts_.start(tracer, sampler);
  if (!start || !start->hit) return;
  Partial partial{Partial::power(start->asked), Partial::power(start->met)};
  Color power = start->power, response(1);
  Ray ray = start->ray;
  Interfaces inside = std::move(start->inside);
  std::optional<Hit> hit = std::move(start->hit);
  bool straight = false, parallel = start->parallel;
  Sampler numbers = sampler;
  for (int bounces = 0; hit && !isBlack(power); ++bounces) {
    aside.goOn();
    partial.arrive(parallel ? 1 : hit->t * hit->t, cosineAt(*hit, ray.direction));
    power *= parallel ? inside.passed(hit->t) : passesOf(tracer, ray, hit->t, inside);
    parallel = false;
    Place& place = sample.lights.emplace_back(tracer, ray, inside, *hit, sample.shift);
    place.power = power;
    place.response = response;
    place.partial = partial;
    place.lit = bounces == 0 && start->light != LightStarts::kNoLight;
    place.straight = straight;
    land(tracer, place, bounces + 2, numbers, sample);
    if (bounces >= depth_ || ways.light == bounces + 2) return;

    const Onward onward(place.at, sample.spectrum);
    Sampler choice = numbers.branch(kChoice);
    const auto next = onward.choose(choice.next(), numbers.branch(kLobe), true, place.lit);
    if (!next) return;
    const Color& weight = next->weight;
    const Real keeps = maxComponent(power * weight) / maxComponent(power);
    const Real goes = bounces < kSurely ? 1 : std::min(1.0, keeps);
    if (!(choice.next() < goes)) return;
    power *= weight * (1 / goes);
    const Vec3 from = -ray.direction, to = next->direction;
    const Real cosine = cosineAt(*hit, to);
    if (next->density > 0)
      partial.leave(next->density, density(place.at.bsdf(), place.at.frame, to, from), cosine);
    else
      partial.reflect(cosine);
    if (bounces == 0) straight = !(next->density > 0);
    if (inside.wavelength == 0 && next->there.wavelength != 0) response = onward.response();
    ray = hit->leave(to);
    inside = next->there;
    numbers = numbers.branch(kNext);
    hit = tracer.cast(ray, RayKind::light, inside, tracer.chance(numbers.branch(kHole)));
  }
}

/// t = 1: the camera sees the place.
void Bidirectional::land(Tracer& tracer, const Place& light, int s, const Sampler& sampler,
                         const Sample& sample) const {
  if (!lands_ || !sample.thrown || !sample.ways.shows(s, 1) || !scatters(light.at.bsdf())) return;
  if (s - 1 > depth_ + 1 || (s - 1 == depth_ + 1 && light.straight)) return;
  const Vec2 lens = camera_.hasLens() ? sampler.branch(kLens).next2() : kCenter;
  const auto seen = camera_.sees(light.hit.surface.point, lens);
  if (!seen || !tracer.world().camera().sees(seen->distance)) return;
  const Vec3 toEye = -seen->ray.direction, from = -light.ray.direction;
  const Real distance2 = camera_.parallel() ? 1 : seen->distance * seen->distance;
  const Color factor = light.power * light.response * scatteredOn(light.at, toEye, from, light.lit);
  if (isBlack(factor)) return;
  const Real perArea = camera_.density(seen->ray) / distance2;
  const Real others = light.partial.others(perArea * cosineAt(light.hit, toEye),
                                           density(light.at.bsdf(), light.at.frame, toEye, from));
  const Real counts = share(s, 1, others, sample);
  if (!(counts > 0)) return;
  const Ray ray = light.hit.leave(toEye);
  const Interfaces there = sideOf(light.at, toEye);
  const Color passed = tracer.visible(light.hit, ray, seen->distance, light.inside) *
                       (there.nested() ? Color(1) : there.passed(seen->distance));
  const Fog fog(tracer.settings());
  const Real clear = fog.none() || !isInOpenAir(there, tracer.world()) ? 1 : fog.passes(ray, seen->distance);
  sample.thrown->push_back({seen->place, factor * passed * (perArea * counts * clear)});
}

/// The radiance along the ray, which is the one cast last and met `hit`; `inside` is what it was in there.
Color Bidirectional::along(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, Path path,
                           const Interfaces& inside, const Sampler& sampler, const Sample& sample) const {
  Gather sum(tracer, path.depth);
  const World& world = tracer.world();
  const int t = path.depth + 2;
  const auto seeMedia = [&](Real far) {
    if (!isThick(tracer)) return;
    if (path.depth > depth_)  // it was sent for what shines only
      coverWithMedia(sum, throughMedia(tracer, ray, far, inside, 0, path.weight, sampler.branch(kFog)));
    else
      addMedia(sum, tracer, ray, far, inside, Color(0), &lamps_, sampler.branch(kFog));
  };
  /// s = 0: what shines there was met with the densities of being asked for and of having started there.
  const auto met = [&](Term::Kind kind, const Color& light, Real asked, Real started) {
    const Partial& p = path.partial;
    const Real others =
        path.kind == RayKind::camera ? 0 : Partial::power(asked) * p.vcm + Partial::power(started) * p.vc;
    const Real counts = share(0, t, others, sample);
    sum.addWay(kind, Color(counts), light, ConnectionTerm{0, t, counts});
  };
  if (path.kind != RayKind::bounce)  // else the light was asked
    if (const auto lamp = world.lampAlong(ray, hit ? hit->t : kInfinity)) {
      sum.add(*lamp);
      seeMedia(lamp->seen.t);
      sum.draw(path.ink);
      return sum.radiance(inside.passed(lamp->seen.t));
    }
  if (!hit) {
    if (world.outside().isSeenBy(path.kind))
      met(Term::Kind::background, world.outside().view(ray, path.kind).color, lamps_.density(ray),
          starts_.ofSky(ray.direction));
    seeMedia(kInfinity);
    sum.draw(path.ink);
    return sum.radiance();
  }
  Footprint footprint;  // null where none is wanted
  if (path.differentials) footprint = arrivedAt(*hit, *path.differentials, ray.direction);
  const Interaction at(tracer, ray, *hit, footprint.get(), inside, sample.shift);
  sum.note(at.bsdf());
  sum.note(at.indices);
  const Real cosine = cosineAt(*hit, ray.direction), distance2 = hit->t * hit->t;
  path.partial.arrive(path.kind == RayKind::camera && camera_.parallel() ? 1 : distance2, cosine);

  if (!isBlack(at.material.emissive))
    met(Term::Kind::emissive, at.material.emissive, lamps_.density(ray.origin, *hit) * cosine / distance2,
        starts_.ofLamp(*hit) * cosine);
  const auto throughMedium = [&] {
    seeMedia(hit->t);
    sum.draw(path.ink);
    return sum.radiance(inside.passed(hit->t));
  };
  if (path.depth > depth_) {  // it was sent for what shines only
    sum.stop(DepthLimit{RayKind::bounce, depth_});
    return throughMedium();
  }
  if (scatters(at.bsdf())) {
    askLights(sum, at, path, sampler, sample);
    askLamps(sum, at, path, sampler, sample);
    int s = 2;
    for (const Place& place : sample.lights) join(sum, at, path, place, s++, sample);
  }
  if (sample.ways.camera == t) return throughMedium();

  const Onward onward(at, sample.spectrum);
  Sampler numbers = sampler.branch(kChoice);
  const Real choice = numbers.next();
  const auto next = onward.choose(choice, sampler.branch(kLobe));
  if (!next) {
    if (onward.totallyReflected(choice)) sum.stop(TotalInternalReflection{});
    return throughMedium();
  }
  const bool splits = inside.wavelength == 0 && next->there.wavelength != 0;
  const Color weight = splits ? next->weight * onward.response() : next->weight;
  const Real most = maxComponent(path.weight * weight);
  const Real goes = path.depth < kSurely ? 1 : std::min(1.0, most);
  if (path.depth >= depth_ && next->kind != RayKind::bounce) {
    sum.stop(DepthLimit{next->kind, depth_});
  } else if (!(most > 0)) {
    sum.stop(BelowThreshold{next->kind, 0, 0});
  } else if (numbers.next() >= goes) {
    sum.stop(Roulette{next->kind, goes});
  } else {
    const Vec3 from = -ray.direction, to = next->direction;
    Path onto{next->kind, path.depth + 1, path.weight * weight * (1 / goes), path.partial, nullptr, 0};
    Footprint widened;
    if (next->kind == RayKind::reflection)
      widened = mirroredAt(world, *hit, footprint.get(), ray.direction, at.normal);
    else if (next->kind == RayKind::refraction)
      widened = refractedAt(world, *hit, footprint.get(), ray.direction, to, at.normal, next->ratio);
    onto.differentials = widened.get();
    if (next->density > 0)
      onto.partial.leave(next->density, density(at.bsdf(), at.frame, to, from), cosineAt(*hit, to));
    else
      onto.partial.reflect(cosineAt(*hit, to));
    const Ray leaving = hit->leave(to);
    Interfaces there = next->there;
    const auto found = tracer.cast(leaving, next->kind, there, tracer.chance(sampler.branch(kHole)));
    const Color arriving = along(tracer, leaving, found, onto, there, sampler.branch(kNext), sample);
    const Term::Kind term = next->kind == RayKind::bounce       ? Term::Kind::bounce
                            : next->kind == RayKind::reflection ? Term::Kind::reflection
                                                                : Term::Kind::refraction;
    sum.add(term, weight * (1 / goes), arriving, ChanceTerm{next->density, 0, 1});
  }
  return throughMedium();
}

/// s = 1: each of the scene's lights.
void Bidirectional::askLights(Gather& sum, const Interaction& at, const Path& path, const Sampler& sampler,
                              const Sample& sample) const {
  Tracer& tracer = at.tracer;
  const World& world = tracer.world();
  const int t = path.depth + 2;
  if (!sample.ways.shows(1, t)) return;
  const Vec3 toEye = -at.ray.direction;
  const Vec3& from = at.hit.surface.point;
  for (std::size_t i = 0; i < world.lights().size(); ++i) {
    if (!world.lights(i, at.hit.object)) continue;
    const Vec2 place =
        world.lightHasSize(i) ? sampler.branch(static_cast<std::uint32_t>(i)).next2() : kCenter;
    auto arriving = world.illuminate(i, from, place);
    if (!arriving) continue;
    const Vec3& toLight = arriving->toLight;
    Ray ray = at.hit.leave(toLight);
    arriving->attenuation *= Fog(tracer.settings()).left(ray, arriving->distance);
    Scatter parts = scatter(at.bsdf(), at.frame, toLight, toEye);
    parts.diffuse *= Color(1 - at.coat);
    const Color all = arriving->scattered(parts);
    if (isBlack(all)) continue;
    const Real others =
        path.partial.others(starts_.overAsked(world, i, *arriving, from) * cosineAt(at.hit, toLight),
                            density(at.bsdf(), at.frame, toLight, toEye));
    const Real counts = share(1, t, others, sample);
    if (!(counts > 0)) continue;
    if (at.material.litThrough) ray.leaves = at.hit.object;  // it is not in its own way
    const Color passed = tracer.visible(at.hit, ray, arriving->distance, at.inside);
    sum.addWay(Term::Kind::light, all * (at.material.shadow * counts), passed, ConnectionTerm{1, t, counts});
    if (at.material.shadow < 1)
      sum.addWay(Term::Kind::light, all * (1 - at.material.shadow), Color(1), ConnectionTerm{1, t, 1});
  }
}

/// s = 1: one place of an object that shines, or of the sky.
void Bidirectional::askLamps(Gather& sum, const Interaction& at, const Path& path, const Sampler& sampler,
                             const Sample& sample) const {
  if (lamps_.empty() || !sample.ways.shows(1, path.depth + 2)) return;
  Sampler numbers = sampler.branch(kLamp);
  const Real which = numbers.next();
  const auto place = lamps_.choose(at.hit.surface.point, which, numbers.next2());
  if (!place) return;
  const Vec3 toEye = -at.ray.direction;
  const int t = path.depth + 2;
  const Color light = scattered(at, toEye, place->toLight);
  if (isBlack(light)) return;
  const auto toward = [&](const Vec3& a, const Vec3& b) { return density(at.bsdf(), at.frame, a, b); };
  const Real others = Partial::power(toward(toEye, place->toLight) / place->density) +
                      path.partial.others(starts_.overAsked(*place) * cosineAt(at.hit, place->toLight),
                                          toward(place->toLight, toEye));
  const Real counts = share(1, t, others, sample);
  if (!(counts > 0)) return;
  const Color seen = lamps_.look(at.tracer, at.hit.leave(place->toLight), *place, sideOf(at, place->toLight),
                                 at.tracer.chance(numbers));
  sum.addWay(Term::Kind::lamp, light * (counts / place->density), seen, ConnectionTerm{1, t, counts});
}

/// s > 1 and t > 1.
void Bidirectional::join(Gather& sum, const Interaction& at, const Path& path, const Place& light, int s,
                         const Sample& sample) const {
  const int t = path.depth + 2, between = s + t - 2;
  if (between > depth_ + 1 || (between == depth_ + 1 && light.straight && s > 2)) return;
  if (!sample.ways.shows(s, t) || !scatters(light.at.bsdf())) return;
  const Vec3 way = light.hit.surface.point - at.hit.surface.point;
  const Real distance2 = dot(way, way), distance = std::sqrt(distance2);
  if (!(distance > 0)) return;
  const Vec3 direction = way / distance, toEye = -at.ray.direction, from = -light.ray.direction;
  const Color here = scattered(at, toEye, direction);
  if (isBlack(here)) return;
  const Color there = scatteredOn(light.at, -direction, from, light.lit);
  if (isBlack(there)) return;
  const auto toward = [](const Interaction& place, const Vec3& a, const Vec3& b) {
    return density(place.bsdf(), place.frame, a, b);
  };
  const Real others =
      light.partial.others(toward(at, toEye, direction) * cosineAt(light.hit, direction) / distance2,
                           toward(light.at, -direction, from)) +
      path.partial.others(toward(light.at, from, -direction) * cosineAt(at.hit, direction) / distance2,
                          toward(at, direction, toEye));
  const Real counts = share(s, t, others, sample);
  if (!(counts > 0)) return;
  Tracer& tracer = at.tracer;
  const Ray ray = at.hit.leave(direction);
  const Interfaces side = sideOf(at, direction);
  Color factor = here * there * light.power * (counts / distance2);
  if (at.inside.wavelength == 0) factor *= light.response;
  if (!side.nested()) factor *= side.passed(distance);
  if (const Fog fog(tracer.settings()); !fog.none() && isInOpenAir(side, tracer.world()))
    factor *= Color(fog.passes(ray, distance));
  sum.addWay(Term::Kind::joined, factor, tracer.visible(at.hit, ray, distance * Lamps::kBefore, at.inside),
             ConnectionTerm{s, t, counts});
}

}  // namespace trace
