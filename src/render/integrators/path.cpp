#include "render/integrators/path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/integrators/path_state.h"
#include "render/media/media.h"
#include "render/paths/interaction.h"
#include "render/paths/subsurface.h"
#include "render/photons/photons.h"
#include "render/rays/firefly.h"
#include "render/samples/sampler.h"
#include "render/world/footprint.h"
#include "shading/materials/subsurface.h"
#include "shading/optics.h"

namespace trace {

namespace {

/// How often a path continues that was scattered that many times and carries so much of what it brings to the
/// sample. Short ones and those that carry half of it surely: to end them spares less time than the noise
/// costs.
Real survival(int bounces, const Color& weight) {
  constexpr int kSurely = 3;
  const Real carries = 2 * maxComponent(weight);
  return bounces < kSurely && carries > 0 ? 1 : std::min(carries, 1.0);
}

/// A direction of that density, which another way of choosing gives with the density `other`: the two are
/// weighed by the power heuristic.
ChanceTerm weighed(Real density, Real other) {
  return {density, other, other > 0 ? density * density / (density * density + other * other) : 1};
}

std::unique_ptr<const SubsurfaceBsdf> takeBody(Interaction& at) {
  const std::optional<SubsurfaceBsdf> body = at.takeBody();
  return body ? std::make_unique<const SubsurfaceBsdf>(*body) : nullptr;
}

}  // namespace

/// The emission where a path arrives, for which lamps are sampled with the density `other`.
ChanceTerm PathTracer::shines(const Path& path, Real other) {
  if (path.forCache) return {path.density, other, other > 0 ? 0.0 : 1.0};
  return weighed(path.density, other);
}

void PathTracer::prepare(const World& world, const Settings& settings, Job& job) {
  lamps_ = Lamps(world, settings.threads);
  depth_ = light_ == Light::straight ? 0 : settings.depth;
  const int passes = light_ == Light::photons ? std::min(settings.photonPasses, samplesOf(settings)) : 1;
  maps_.resize(static_cast<std::size_t>(passes));
  gathers_ = light_ == Light::photons && gathersFinally(settings);
  photonsTell_ = light_ == Light::photons && !gathers_;
  mostScattered_ = light_ == Light::bounced ? settings.mediumDepth : 1;
  if (light_ != Light::photons) return;
  Work work("sending photons", passes);
  for (int pass = 0; pass < passes && !job.cancel; ++pass) {
    Maps& maps = maps_[static_cast<std::size_t>(pass)];
    maps.caustics = causticMap(world, settings, &lamps_, job, pass);
    if (job.cancel) return;
    GlobalMaps all = globalMaps(world, settings, lamps_, job, pass);
    maps.all = std::move(all.surfaces);
    maps.media = std::move(all.media);
    work.reached(pass + 1);
  }
  if (settings.irradianceCache > 0) fillCache(world, settings, job);
}

Color PathTracer::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Path path;
  path.differentials = camera.differentials;
  path.ink = camera.ink;
  path.maps = &maps_[static_cast<std::size_t>(sampler.sample()) % maps_.size()];
  return along(tracer, camera.ray, camera.hit, path, camera.inside, sampler);
}

/// The radiance along the ray, which is the one cast last and met `hit`; `inside` is what it was in there. In
/// media it may continue ten thousand times: no call for each.
Color PathTracer::along(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
                        const Interfaces& inside, const Sampler& sampler) const {
  std::unique_ptr<Scattering> after;
  Color light = arrives(tracer, ray, hit, path, inside, sampler, after);
  if (!after) return light;
  std::vector<std::unique_ptr<Scattering>> places;
  while (after) {
    const Scattering& from = *places.emplace_back(std::move(after));
    light = arrives(tracer, from.ray, from.hit, from.path, from.inside, from.sampler, after);
  }
  for (; !places.empty(); places.pop_back()) {
    Scattering& at = *places.back();
    at.sum.add(at.factor * allowedPart(tracer, at.path.weight * light), light, at.how,
               ChanceTerm{at.path.density, 0, 1});
    light = at.sum.radiance(at.passed);
  }
  return light;
}

/// The same up to where a medium scatters it to `after`.
Color PathTracer::arrives(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
                          const Interfaces& inside, const Sampler& sampler,
                          std::unique_ptr<Scattering>& after) const {
  const World& world = tracer.world();
  // Photons have brought the emitter there.
  const bool photonsBring = !path.maps->caustics.empty();
  const bool brought = path.bounced && path.kind != RayKind::bounce && photonsBring;
  const auto lamp =
      path.asked || path.within || brought ? std::nullopt : world.lampAlong(ray, hit ? hit->t : kInfinity);
  const Real end = lamp ? lamp->seen.t : hit ? hit->t : kInfinity;
  const bool onlyShines = path.depth > depth_ || path.scattered >= mostScattered_;  // is it sent for
  std::optional<MediumWay> media;
  if (isThick(tracer) && !path.within) {
    Sampler numbers = sampler.branch(Branch::medium);
    media = throughMedia(tracer, ray, end, inside, onlyShines || path.told ? 0 : 1, path.weight,
                         numbers.branch(0));
    if (const auto place = placeByChance(*media, path.weight, numbers.next()))
      return scattered(tracer, ray, *media, *place, path, inside, sampler, after);
  }
  Gather sum(tracer, path.depth);
  const auto seeMedia = [&] {
    if (media) coverWithMedia(sum, *media);
    sum.draw(path.ink);
  };
  if (lamp) {
    sum.add(*lamp);
    seeMedia();
    return sum.radiance(inside.passed(end));
  }
  if (!hit) {
    if (world.outside().isSeenBy(path.kind) && !brought) {
      const ChanceTerm chance = shines(path, path.density > 0 || path.forCache ? lamps_.density(ray) : 0);
      sum.add(Term::Kind::background, Color(chance.share), world.outside().view(ray, path.kind).color,
              chance);
    }
    seeMedia();
    return sum.radiance();
  }
  Footprint footprint;  // none where none is wanted
  if (path.differentials) footprint = arrivedAt(*hit, *path.differentials, ray.direction);
  // Numbers are drawn where something is to be chosen.
  const bool splits = tracer.settings().wavelengths > 1;
  Vec2 choice = splits ? sampler.branch(Branch::choice).next2() : Vec2{};
  // One number chooses where all wavelengths lie, and which of them: the two must not depend on each other.
  const Real wavelength = choice.y * tracer.settings().wavelengths;
  Interaction at(tracer, ray, *hit, footprint.get(), inside, wavelength - std::floor(wavelength));
  std::unique_ptr<const SubsurfaceBsdf> body;  // apart: nearly everywhere there is none
  if (path.within)
    at.letIn();
  else if (world.hasSubsurface())
    body = takeBody(at);
  sum.note(at.bsdf());
  sum.note(at.raised());
  sum.note(at.indices);

  const ChanceTerm chance =
      shines(path, path.density > 0 || path.forCache ? lamps_.density(ray.origin, *hit) : 0);
  if (!brought && !path.within)
    sum.add(Term::Kind::emissive, Color(chance.share), at.material.emissive, chance);
  const auto throughMedium = [&] {
    seeMedia();
    return sum.radiance(path.within ? Color(1) : inside.passed(hit->t));
  };
  if (onlyShines) {
    sum.stop(DepthLimit{RayKind::bounce, path.depth > depth_ ? depth_ : mostScattered_});
    return throughMedium();
  }
  // A gathering ray may end nearer than the photons lie of which the estimate would be made: they might be
  // behind the wall that it comes from. Then the place looks around by itself (Jensen 2001); and where they
  // lie beyond an edge, too.
  bool gathers = path.gathers;
  if (gathers && scatters(at.bsdf())) {
    const PhotonMap::Near near = at.photonsOf(path.maps->all);
    gathers = (path.kind != RayKind::bounce || !(hit->t * hit->t < near.radius2)) &&
              at.hasDisk(std::sqrt(near.radius2), sampler.branch(Branch::photonDisk));
    if (gathers) at.addPhotons(sum, Term::Kind::photons, near, true);
  }
  const bool glossy = isGlossy(at.bsdf()), told = path.told && !(path.near && at.sendsEvenly());
  const bool asks = !gathers && !told;
  if (asks) {
    if (!world.lights().empty()) at.addLights(sum, sampler);
    at.addCaustics(sum, path.maps->caustics, sampler.branch(Branch::caustics));
  }
  // The photon map gives the scattered light. Not where a part of the disk on which they lie is beyond an
  // edge, or below what stands there: from there the path continues. So it does to surfaces that are near
  // compared with the disk, whose light changes within it, except for what their mirrors and lobes throw.
  constexpr Real kApart = 4;  // radii of the disk: then light of a small source is blurred by 4 % at most
  bool tells = asks && photonsTell_ && !glossy && scatters(at.bsdf());
  Real apart = 0;
  if (tells) {
    const PhotonMap::Near near = at.photonsOf(path.maps->all);
    const Real radius = std::sqrt(near.radius2);
    tells = at.hasDisk(radius, sampler.branch(Branch::photonDisk));
    apart = kApart * radius;
    if (tells) at.addPhotons(sum, Term::Kind::photons, near, true, 1, apart);
  }

  // Which of the surface's rays is followed: one into its lobe, the mirrored or a refracted one.
  const auto shares = glossy ? at.shares().first(0) : at.shares();
  const SpectralShare* share =
      shares.empty() ? nullptr
                     : &shares[static_cast<std::size_t>(choice.y * static_cast<Real>(shares.size()))];
  const Color mirror = at.mirror(true);
  const Color through =
      share ? at.filter(*share) * share->weight * static_cast<Real>(shares.size()) : Color(0);
  const Real mirrors = maxComponent(mirror), passes = maxComponent(through);
  constexpr Real kLeastLobe = 0.2;  // what is scattered is not known beforehand
  const bool cached = !path.gathers && addCached(sum, at);
  const bool follows = scatters(at.bsdf()) && asks && !cached;
  const Real intoLobe = !follows ? 0 : body ? kLeastLobe : std::max(kLeastLobe, 1 - mirrors - passes);
  const Real inBody =
      body && !path.told ? maxComponent(body->albedo) * maxComponent(body->passes(at.cosine)) : 0;
  const bool both = body && path.depth == 0;  // what is seen first is followed into the body besides
  const Real all = intoLobe + mirrors + passes + (both ? 0 : inBody);
  const Real toLobe = all > 0 ? intoLobe / all : 0, toMirror = all > 0 ? mirrors / all : 0;
  const Real toBody = all > 0 ? inBody / all : 0;
  if (!splits && toLobe < 1) choice.x = sampler.branch(Branch::choice).next();
  if (toLobe > 0 || cached) addLamp(sum, at, toLobe, sampler);

  /// Whether a ray of that weight continues, and for how many it then stands.
  const auto goesOn = [&](RayKind kind, const Color& weight) -> std::optional<Real> {
    const Real goes = survival(path.depth, path.weight * weight);
    if (path.depth >= depth_ && kind != RayKind::bounce)
      sum.stop(DepthLimit{kind, depth_});
    else if (!(goes > 0) || ((kind == RayKind::bounce ? told : path.told) && photonsBring))
      sum.stop(BelowThreshold{kind, 0, 0});
    else if (goes < 1 && sampler.branch(Branch::roulette).next() >= goes)
      sum.stop(Roulette{kind, goes});
    else
      return 1 / goes;
    return {};
  };
  const auto follow = [&](RayKind kind, Term::Kind term, const Vec3& direction, const Color& weight,
                          Real density, Interfaces there, const Footprint& widened) {
    const auto stands = goesOn(kind, weight);
    if (!stands) return;
    const Color factor = weight * *stands;
    Path next{kind,
              path.depth + 1,
              path.weight * factor,
              density,
              widened.get(),
              0,
              path.gathers || (gathers_ && kind == RayKind::bounce && !glossy),
              path.maps,
              path.scattered};
    next.asked = kind == RayKind::bounce ||
                 (kind == RayKind::refraction && path.asked && tracer.lightPasses(at.bsdf()));
    next.bounced = path.bounced || kind == RayKind::bounce;
    const Ray onward = kind == RayKind::bounce ? at.leaveToLight(direction) : hit->leave(direction);
    const std::optional<Hit> met =
        tracer.cast(onward, kind, there, tracer.chance(sampler.branch(Branch::hole)));
    next.told = (kind == RayKind::bounce ? told : path.told) || (tells && kind == RayKind::bounce);
    next.near = tells && kind == RayKind::bounce && met && met->t < apart;
    const Color arriving = along(tracer, onward, met, next, there, sampler.branch(Branch::next));
    const Real part = kind == RayKind::bounce ? allowedPart(tracer, path.weight * factor * arriving) : 1;
    sum.add(term, factor * part, arriving, {density, 0, 1});
  };

  const auto throughBody = [&](std::uint32_t n, Real part) {
    const Sampler own = sampler.branch(Branch::pathBody).branch(n);
    const auto in = entrance(at, *body, path.weight, own.branch(0));
    if (!in) return;
    const Color factor = in->weight * part;
    const Path next{RayKind::refraction, path.depth, path.weight * factor, 0, nullptr, 0, gathers, path.maps,
                    path.scattered,      true};
    sum.add(factor, along(tracer, in->ray, in->hit, next, inside, own.branch(1)), in->how);
  };

  const int places = both ? tracer.settings().subsurfaceSamples : 0;
  for (int n = 0; n < places; ++n) throughBody(static_cast<std::uint32_t>(n), 1.0 / places);
  if (all > 0 && choice.x < toLobe) {
    const Vec2 where = sampler.branch(Branch::next).branch(Branch::arrival).next2();
    const Real choose = hasOneLobe(at.bsdf()) ? 0 : sampler.branch(Branch::lobe).next();
    const auto drawn = sample(at.bsdf(), at.frame, -ray.direction, choose, where, Transport::importance);
    const bool inward = drawn && dot(drawn->toLight, at.normal) < 0;
    const bool astray = drawn && !inward && at.isAstray(drawn->toLight);
    if (drawn && !astray && !isBlack(drawn->weight))
      follow(RayKind::bounce, Term::Kind::bounce, drawn->toLight, drawn->weight * ((1 - at.coat) / toLobe),
             drawn->density * toLobe, inward && at.transmits ? at.behind() : inside, {});
  } else if (all > 0 && choice.x < toLobe + toMirror) {
    follow(RayKind::reflection, Term::Kind::reflection, mirrored(ray.direction, at.normal), mirror / toMirror,
           0, inside, mirroredAt(world, *hit, footprint.get(), ray.direction, at.normal));
  } else if (!both && toBody > 0 && choice.x < toLobe + toMirror + toBody) {
    throughBody(0, 1 / toBody);
  } else if (share && passes > 0) {
    if (const auto direction = at.through(*share)) {
      Interfaces behind = at.behind();
      behind.wavelength = share->nanometres;
      follow(
          RayKind::refraction, Term::Kind::refraction, *direction, through * (all / passes), 0, behind,
          refractedAt(world, *hit, footprint.get(), ray.direction, *direction, at.normal, at.ratio(*share)));
    } else {
      sum.stop(TotalInternalReflection{});
    }
  }
  return throughMedium();
}

/// The radiance along the ray where a medium on its way scatters light to it; unknown where it continues.
Color PathTracer::scattered(Tracer& tracer, const Ray& ray, const MediumWay& way,
                            const MediumWay::Place& place, const Path& path, const Interfaces& inside,
                            const Sampler& sampler, std::unique_ptr<Scattering>& after) const {
  after.reset(new Scattering{.sum = {tracer, path.depth},
                             .how = {MediumTerm::What::follows, place.object, place.t, place.forward},
                             .passed = inside.passed(place.t),
                             .inside = inside,
                             .sampler = sampler.branch(Branch::next)});
  Gather& sum = after->sum;
  const MediumTerm term{MediumTerm::What::scatters, place.object, place.t, place.forward};
  if (!isBlack(way.glows)) sum.add(Color(1), way.glows, MediumTerm{MediumTerm::What::glows});
  const ScatterPlace at{ray, ray.at(place.t), place.weight, place.forward, inside, term};
  const Sampler numbers = sampler.branch(Branch::medium).branch(1);
  addLightsAt(sum, tracer, at, numbers);
  addLampAt(sum, tracer, at, lamps_, true, numbers);
  addPhotonsAt(sum, at, path.maps->media, sampler.branch(Branch::photonDisk));

  Sampler lobe = sampler.branch(Branch::lobe);
  const Real goes = survival(path.depth + path.scattered, path.weight * place.weight);
  if (!(lobe.next() < goes)) {
    sum.stop(Roulette{RayKind::bounce, goes});
    const Color light = sum.radiance(after->passed);
    after.reset();
    return light;
  }
  const auto [direction, density] = samplePhase(ray.direction, place.forward, lobe.next2());
  after->factor = place.weight / goes;
  Path& next = after->path;
  next = {RayKind::bounce, path.depth, path.weight * after->factor, density, nullptr, 0,
          path.gathers,    path.maps,  path.scattered + 1};
  next.asked = true;
  after->ray = {at.point, direction};
  after->hit =
      tracer.cast(after->ray, RayKind::bounce, after->inside, tracer.chance(sampler.branch(Branch::hole)));
  return {};
}

/// The light of one place on an emissive object; `shareOfLobe` is how often a ray into the lobe is
/// followed.
void PathTracer::addLamp(Gather& sum, const Interaction& at, Real shareOfLobe, const Sampler& sampler) const {
  if (lamps_.empty()) return;
  Sampler numbers = sampler.branch(Branch::lamp);
  // The second pair of the numbers that led here: what depends on both is spread evenly, too.
  const Vec2 where = sampler.branch(Branch::arrival).second2();
  const Real which = lamps_.isOne() ? 0 : numbers.next();
  auto place = lamps_.choose(at.lightPlace(), which, where);
  if (!place) return;
  const Vec3 toEye = -at.ray.direction;
  const Color scattered =
      evaluate(at.bsdf(), at.frame, toEye, place->toLight, Transport::importance) * (1 - at.coat);
  const bool inward = dot(place->toLight, at.normal) < 0;
  if (isBlack(scattered) || (!inward && at.isAstray(place->toLight))) return;
  const Real other = shareOfLobe * density(at.bsdf(), at.frame, toEye, place->toLight);
  const ChanceTerm chance = weighed(place->density, other);
  const Ray toLamp = at.leaveToLight(place->toLight);
  const Real hole = at.tracer.chance(numbers);
  const Color seen = inward && at.transmits ? lamps_.look(at.tracer, toLamp, *place, at.behind(), hole)
                                            : lamps_.look(at.tracer, toLamp, *place, at.inside, hole);
  Color factor = scattered * (chance.share / place->density);
  if (!at.tracer.world().media().empty() && !isBlack(seen))
    factor *= passedByBodies(at.tracer, toLamp, place->distance, sampler.branch(Branch::pathToLamp));
  sum.add(Term::Kind::lamp, factor, seen, chance);
}

}  // namespace trace
