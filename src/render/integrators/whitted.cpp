#include "render/integrators/whitted.h"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "math/low_discrepancy.h"
#include "render/media/lamp_light.h"
#include "render/paths/path_place.h"
#include "render/paths/subsurface.h"
#include "render/rays/fog.h"
#include "render/rays/gather.h"
#include "render/world/footprint.h"
#include "shading/materials/subsurface.h"
#include "shading/optics/dispersion.h"
#include "shading/optics/optics.h"

namespace trace {

struct Whitted::Path {
  RayKind kind = RayKind::camera;
  int depth = 0;
  Color weight{1};    ///< the largest share of the pixel that this ray can still make
  Real spread = 0.5;  ///< where the wavelengths of a fan lie: spectralFan()
  const Differentials* differentials = nullptr;  ///< differentials of the ray, if footprints are needed
  Real ink = 0;                                  ///< how much of it an outline covers
};

void Whitted::prepare(const World& world, const Settings& settings, Job& job) {
  if (settings.lampSamples > 0) lamps_ = Lamps(world, settings.threads, true);
  if (settings.caustics > 0)
    caustics_ = gatheredCaustics(world, settings, lamps_.empty() ? nullptr : &lamps_, job);
}

/// Covers the sum with fog and other media that the ray ran through up to t.
[[gnu::always_inline]] inline void Whitted::seeMedia(Gather& sum, Tracer& tracer, const Ray& ray, Real t,
                                                     const Interfaces& inside, const Sampler& sampler) const {
  const World& world = tracer.world();
  const bool bodies = !world.media().empty();
  if (!bodies && !(tracer.settings().fog > 0)) return;
  const Lamps* lamps = lamps_.empty() ? nullptr : &lamps_;
  bodies ? addMedia(sum, tracer, ray, t, inside, world.ambient(), lamps, sampler.branch(Branch::whittedFog))
         : addFog(sum, tracer, ray, t, inside, world.ambient(), lamps, sampler.branch(Branch::whittedFog));
}

/// The radiance along the last ray that was cast, which ends at `hit`; `inside` is what it was in there.
Color Whitted::along(Tracer& tracer, const Ray& ray, const std::optional<Hit>& hit, const Path& path,
                     const Interfaces& inside, const Sampler& sampler) const {
  Gather sum(tracer, path.depth);
  const World& world = tracer.world();
  const auto arriving = [&](Real t, const Color& passed) {
    seeMedia(sum, tracer, ray, t, inside, sampler);
    sum.draw(path.ink);
    return sum.radiance(passed);
  };
  if (const auto lamp = world.lampAlong(ray, hit ? hit->t : kInfinity)) {
    sum.add(*lamp);
    return arriving(lamp->seen.t, inside.passed(lamp->seen.t));
  }
  if (!hit) {
    if (world.outside().isSeenBy(path.kind))
      sum.add(Term::Kind::background, world.outside().view(ray, path.kind).color);
    return arriving(kInfinity, Color(1));
  }
  const Settings& settings = tracer.settings();
  Footprint footprint;  // none where none is wanted
  if (path.differentials) footprint = arrivedAt(*hit, *path.differentials, ray.direction);
  Interaction at(tracer, ray, *hit, footprint.get(), inside, path.spread);
  std::unique_ptr<const SubsurfaceBsdf> body;
  if (world.hasSubsurface()) body = at.takeBody();
  sum.note(at.bsdf());
  sum.note(at.raised());
  const WhittedTerms& material = at.material;

  sum.add(Term::Kind::emissive, material.emissive);
  const Color ambient = material.ambient * (1 - at.coat);
  if (settings.ambientOcclusion > 0 && !isBlack(ambient * world.ambient()))
    at.addOpen(sum, Term::Kind::ambient, ambient * world.ambient(), settings.ambientOcclusion, sampler);
  else
    sum.add(Term::Kind::ambient, ambient, world.ambient());
  at.addLights(sum, sampler);
  const bool glossy = settings.glossy && isGlossy(at.bsdf());
  if (!lamps_.empty()) addLamps(sum, at, glossy, sampler);
  if (body) addBody(sum, at, *body, path, sampler);
  if (settings.caustics > 0) addCaustics(sum, at);

  const auto worthwhile = [&](const Path& next) {
    if (next.depth > settings.depth)
      sum.stop(DepthLimit{next.kind, settings.depth});
    else if (isBlack(next.weight) || maxComponent(next.weight) < settings.threshold)
      sum.stop(BelowThreshold{next.kind, maxComponent(next.weight), settings.threshold});
    else
      return true;
    return false;
  };
  const auto onward = [&](RayKind kind, const Color& share) {
    return Path{kind, path.depth + 1, path.weight * share * hit->opacity, path.spread};
  };
  const auto send = [&](Term::Kind term, const Color& share, Path next, const Footprint& widened,
                        const Vec3& to, Interfaces there, const Sampler& numbers) {
    next.differentials = widened.get();
    sum.add(term, share, follow(tracer, hit->leave(to), next, std::move(there), numbers));
  };
  sum.note(at.indices);
  if (glossy) {  // one ray into the lobe, in place of those that stand for its core
    Sampler numbers = sampler.branch(Branch::whittedLobe);
    const Real choose = numbers.next();
    const auto drawn =
        sample(at.bsdf(), at.frame, -ray.direction, choose, numbers.next2(), Transport::importance);
    const Color lobe = drawn ? scatter(at.bsdf(), at.frame, drawn->toLight, -ray.direction).specular *
                                   (1 / (kPi * drawn->density))
                             : Color(0);
    if (!isBlack(lobe)) {
      const bool through = dot(drawn->toLight, at.normal) < 0;
      const Color share = lobe * (1 - at.coat);
      const Path next = onward(through ? RayKind::refraction : RayKind::reflection, share);
      if (worthwhile(next))
        send(termOf(next.kind), share, next, {}, drawn->toLight, through ? at.behind() : inside,
             sampler.branch(Branch::mirrored, through));
    }
  }
  if (const Color mirror = at.mirror(glossy); !isBlack(mirror)) {
    if (const Path next = onward(RayKind::reflection, mirror); worthwhile(next))
      send(Term::Kind::reflection, mirror, next,
           mirroredAt(world, *hit, footprint.get(), ray.direction, at.normal),
           mirrored(ray.direction, at.normal), inside, sampler.branch(Branch::mirrored));
  }
  std::uint32_t fan = 0;
  bool total = false;
  for (const SpectralShare& share : glossy ? at.shares().first(0) : at.shares()) {
    const Color filter = share.weight * at.filter(share);
    const Path next = onward(RayKind::refraction, filter);
    const std::uint32_t number = fan++;
    if (isBlack(filter) && !at.through(share)) {  // by Fresnel's equations nothing is left for it
      if (!std::exchange(total, true)) sum.stop(TotalInternalReflection{});
      continue;
    }
    if (!worthwhile(next)) continue;
    if (const auto to = at.through(share)) {
      Interfaces behind = at.behind();
      behind.wavelength = share.nanometres;
      send(Term::Kind::refraction, filter, next,
           refractedAt(world, *hit, footprint.get(), ray.direction, *to, at.normal, at.ratio(share)), *to,
           std::move(behind), sampler.branch(Branch::refracted, number));
    } else if (!std::exchange(total, true)) {
      sum.stop(TotalInternalReflection{});
    }
  }
  if (const Real hole = 1 - hit->opacity; hole > 0) {
    sum.cover(Term::Kind::hole, hole);
    const Path next{path.kind, path.depth + 1, path.weight * hole, path.spread};
    if (worthwhile(next))
      send(Term::Kind::hole, Color(hole), next,
           refractedAt(world, *hit, footprint.get(), ray.direction, ray.direction, at.normal, 1),
           ray.direction, inside, sampler.branch(Branch::whittedStraight));
  }
  return arriving(hit->t, inside.passed(hit->t));
}

/// The radiance along a ray that starts in `inside`.
Color Whitted::follow(Tracer& tracer, const Ray& ray, const Path& path, Interfaces inside,
                      const Sampler& sampler) const {
  // A point seen through a hole may be nearer to that than the camera sees.
  const RayKind kind = path.kind == RayKind::camera ? RayKind::refraction : path.kind;
  const std::optional<Hit> hit = tracer.cast(ray, kind, inside);
  return along(tracer, ray, hit, path, inside, sampler);
}

/// Adds the light that comes out of the body, of lights and lamps where it goes in.
void Whitted::addBody(Gather& sum, const Interaction& at, const SubsurfaceBsdf& body, const Path& path,
                      const Sampler& sampler) const {
  const int places = at.tracer.settings().subsurfaceSamples;
  const Sampler numbers = sampler.branch(Branch::whittedBody);
  for (int n = 0; n < places; ++n) {
    const Sampler own = numbers.branch(static_cast<std::uint32_t>(n));
    const auto in = entrance(at, body, path.weight, own.branch(0));
    if (!in) continue;
    Color light;
    {
      Gather there(at.tracer, path.depth);
      Interaction entering(at.tracer, in->ray, in->hit, nullptr, at.inside, path.spread);
      entering.letIn();
      there.note(entering.bsdf());
      entering.addLights(there, own);
      if (!lamps_.empty()) addLamps(there, entering, false, own);
      light = there.radiance();
    }
    sum.add(in->weight * (1.0 / places), light, in->how);
  }
}

/// Adds what mirrors and glass have gathered there, as the surface scatters it evenly.
void Whitted::addCaustics(Gather& sum, const Interaction& at) const {
  const IlluminationMap& texels = caustics_.texels;
  const auto place = texels.place(at.tracer.world(), at.ray, at.hit);
  if (!place) {
    if (!caustics_.photons.empty() && scatters(at.bsdf()))
      at.addPhotons(sum, Term::Kind::caustic, at.photonsOf(caustics_.photons), false);
    return;
  }
  const Scatter parts = scatter(at.bsdf(), at.frame, at.normal, -at.ray.direction);
  sum.add(Term::Kind::caustic, parts.diffuse * ((1 - at.coat) / kPi), texels.at(*place));
}

/// Adds the light of places on lamps, filtered by the glass in between. `glossy`: a ray into the lobe finds
/// what the lobe mirrors.
void Whitted::addLamps(Gather& sum, const Interaction& at, bool glossy, const Sampler& sampler) const {
  Tracer& tracer = at.tracer;
  const int rays = tracer.settings().lampSamples;
  Sampler numbers = sampler.branch(Branch::whittedLamps);
  const Vec2 first = numbers.next2();
  const Real which = numbers.next();
  const auto weigh = [&](Lamps::Place& place, bool) {
    const Vec3& to = place.toLight;
    const Scatter parts = scatter(at.bsdf(), at.frame, to, -at.ray.direction);
    Color factor = (glossy ? parts.diffuse : parts.sum()) * ((1 - at.coat) / (kPi * place.density * rays));
    const bool astray = !(dot(to, at.normal) < 0) && at.isAstray(to);
    if (isBlack(factor) || astray) return LampWeight<ChanceTerm>{};
    const Ray ray = at.leaveToLight(to);
    factor *= lamps_.sent(tracer, ray, place);
    if (tracer.settings().fog > 0) factor *= Color(Fog(tracer.settings()).left(ray, place.distance));
    return LampWeight<ChanceTerm>{factor, {place.density, 0, 1, place.object}};
  };
  for (int n = 0; n < rays; ++n) {
    const auto number = static_cast<std::uint32_t>(n);
    askLamp<LampRay::filtered>(
        sum, lamps_, PathPlace(at), {(n + which) / rays, rotated(sobolPoint(number), first)},
        [] { return 0; }, [&] { return sampler.branch(Branch::whittedToLamp).branch(number); }, weigh);
  }
}

Color Whitted::radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const {
  Path path;
  path.spread = vanDerCorput(static_cast<std::uint32_t>(sampler.sample()) + 1);
  path.differentials = camera.differentials;
  path.ink = camera.ink;
  return along(tracer, camera.ray, camera.hit, path, camera.inside, sampler);
}

}  // namespace trace
