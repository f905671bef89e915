// The way of a photon from its start on.
#include <algorithm>

#include "render/paths/onward.h"
#include "render/paths/subsurface.h"
#include "render/photons/photon_emitter.h"
#include "shading/materials/subsurface.h"
#include "shading/optics/optics.h"

namespace trace {
namespace {

/// The light that a photon carries on in a direction, times the cosine, as an eye there would see it: not
/// every model is the same both ways. Where the shading normal is far from the true one, that counts at most
/// that often (Veach 1997, section 5.3.2).
Color scatteredPhoton(const Interaction& at, const Vec3& direction) {
  constexpr Real kMost = 4;
  const Vec3& normal = at.hit.surface.normal;
  const Real shaded = dot(at.ray.direction, at.normal) * dot(direction, normal);
  const Real seen = dot(at.ray.direction, normal) * dot(direction, at.normal);
  const Real most = kMost * std::abs(seen), factor = std::abs(shaded);
  return scatteredOn(at, direction, -at.ray.direction) * (factor > most ? most / factor : 1);
}

}  // namespace

/// The part of the light over a solid angle that falls on a surface there, by the light's own law.
Real PhotonEmitter::fallsOn(const Flight& flight, const Vec3& point) const {
  const auto arriving = world_.illuminate(*flight.light, point, flight.onLight);
  if (!arriving) return 0;
  const Vec3 way = flight.start ? point - *flight.start : Vec3{};
  return arriving->attenuation * (flight.start ? dot(way, way) : 1);
}

/// The power with which the photon gets to a place at the distance t. Behind a pane the light is as strong as
/// a shadow ray through it finds it: by the light's own law, which need not be the square of the distance.
Color PhotonEmitter::arriving(const Flight& f, const Vec3& point, Real t) const {
  if (f.light && f.bounces == 0 && f.scatterings == 0) {
    // The light that falls on a surface there that faces the light, over the solid angle or the area.
    const auto light = world_.illuminate(*f.light, point, f.onLight);
    if (!light) return Color(0);
    const Real away2 = f.start ? t * t : 1;
    return f.power * light->intensity() * (kPi * away2 * f.share / f.count);
  }
  return f.law > 0 ? f.power * Color(fallsOn(f, point) / f.law) : f.power;
}

/// Whether a surface that scatters keeps it.
bool PhotonEmitter::rests(const Flight& f) const {
  return kept_ == Kept::all || (kept_ == Kept::scattered ? f.scattered : f.bounces > 0 && f.gathered);
}

/// Whether a path that media scatter that often counts. Seen from the eye, the last scattering that
/// `medium-depth` allows is lit by lights alone, not by surfaces; so light must have hit a medium first.
bool PhotonEmitter::counts(int scatterings, bool mediumFirst) const {
  return scatterings < settings_.mediumDepth || (scatterings == settings_.mediumDepth && mediumFirst);
}

/// The photon, whose power that is already, continues from there as a medium scatters it.
void PhotonEmitter::scatter(Flight& f, const Vec3& point, Real forward) {
  f.mediumFirst = f.mediumFirst || f.untouched();
  f.ray = {point, samplePhase(f.ray.direction, forward, {chance(), chance()}).direction};
  f.parallel = f.fromSky = f.straight = f.asked = f.offSurface = false;
  f.gathered = f.scattered = true;
  f.law = 0;
  ++f.scatterings;
  if (!isBlack(f.power)) cast(f);
}

/// The scattering of parallel light by fog, which is as strong in front of fog as behind: a photon of its
/// own, from a place within the scene. Light of the sky has come through fog.
void PhotonEmitter::lightFog(const Flight& parallel, LandedPhotons& landed) {
  const Box3& box = world_.bounds();
  const Ray& ray = parallel.ray;
  const Vec3 way = box.center() - ray.origin;
  const Real middle = dot(way, ray.direction), radius = length(box.size()) / 2;
  const Real half2 = radius * radius - (dot(way, way) - middle * middle);
  if (!(half2 > 0) || !isInOpenAir(parallel.inside, world_)) return;
  if (!counts(parallel.scatterings + 1, parallel.untouched())) return;
  const Real near = middle - std::sqrt(half2), first = parallel.panes > 0 ? std::max(0.0, near) : near;
  const Real last = std::min(middle + std::sqrt(half2), parallel.hit ? parallel.hit->t : kInfinity);
  const Ray within{ray.at(first), ray.direction};
  const Real depth = last > first ? fog_.depth(within, last - first) : 0;
  if (!(depth > 0)) return;
  const Real t = first + fog_.distance(within, chance() * depth);
  const Vec3 point = ray.at(t);
  if (!isFinite(point)) return;
  numbers_.next();
  Flight own = parallel;
  own.power = arriving(parallel, point, t) * settings_.fogColor * depth *
              passedByBodies(tracer_, ray, t, Sampler(rules_, numbers_));
  if (parallel.fromSky) own.power *= Color(fog_.passes({point, -ray.direction}, kInfinity));
  scatter(own, point, fog_.forward());
  fly(own, landed);
}

/// The way up to the next surface: the transmittance, and what media absorb. True if it was scattered there.
bool PhotonEmitter::crossMedia(Flight& f, LandedPhotons& landed) {
  if (f.parallel && !onlyCaustics_ && !fog_.none()) lightFog(f, landed);
  const Real far = f.hit ? f.hit->t : kInfinity;
  const bool keeps = !onlyCaustics_ && counts(f.scatterings + 1, f.mediumFirst || f.untouched());
  numbers_.next();
  MediumWay way = throughMedia(tracer_, f.ray, far, f.inside, keeps ? 1 : 0, Color(1),
                               Sampler(rules_, numbers_), !f.parallel);
  if (!way.places.empty()) {
    const MediumWay::Place& place = way.places.front();
    const Vec3 point = f.ray.at(place.t);
    const Color power = arriving(f, point, place.t) * f.inside.passed(place.t);
    const Color fluence = power * place.arrives;
    if (!f.asked && isFinite(fluence)) landed.inMedia.push_back({point, f.ray.direction, {}, fluence});
    if (const auto where = placeByChance(way, power, chance())) {
      f.power = power * where->weight;
      const Real goes = std::min(1.0, maxComponent(f.power) / maxComponent(power));
      f.power = chance() < goes ? f.power / goes : Color(0);
      scatter(f, point, where->forward);
      return true;
    }
  }
  f.power *= way.passes;
  if (f.fromSky && f.hit && isInOpenAir(f.inside, world_))
    f.power *= Color(fog_.passes({f.hit->surface.point, -f.ray.direction}, kInfinity));
  return false;
}

void PhotonEmitter::fly(Flight& f, LandedPhotons& landed) {
  const bool thick = isThick(tracer_);
  while (f.hit || thick) {
    if (isBlack(f.power)) return;
    if (thick && crossMedia(f, landed)) continue;
    if (!f.hit) return;
    f.power = arriving(f, f.hit->surface.point, f.hit->t) * f.inside.passed(f.hit->t);
    if (isBlack(f.power)) return;
    // A pane that the light does not light has no effect.
    const bool linked = !f.straight || !f.light || world_.lights(*f.light, f.hit->object);
    Interaction at(tracer_, f.ray, *f.hit, nullptr, f.inside, chance());
    const bool scattersIt = scatters(at.bsdf());
    std::unique_ptr<const SubsurfaceBsdf> body;
    if (world_.hasSubsurface()) body = at.takeBody();
    if (scattersIt && linked && rests(f) && counts(f.scatterings, f.mediumFirst)) {
      if (const auto place = texels_.place(world_, f.ray, *f.hit))
        landed.onMaps.emplace_back(*place, f.power);
      else
        landed.photons.push_back({f.hit->surface.point, f.ray.direction, at.trueNormal(), f.power,
                                  f.offSurface ? f.hit->t : kInfinity});
    }
    if (f.bounces - f.panes >= settings_.depth || !goOn(f, at, scattersIt, body.get())) return;
    if (!linked && !f.straight) return;
    const bool pane = f.straight && f.light && !f.gathered;
    f.parallel = f.parallel && pane;
    f.fromSky = false;
    ++f.bounces;
    f.panes += pane;
    cast(f);
  }
}

/// One ray continues from the surface, or none: what it brings stays about the same. False if it ends.
bool PhotonEmitter::goOn(Flight& f, const Interaction& at, bool scattersIt, const SubsurfaceBsdf* body) {
  const auto shares = at.shares();
  const SpectralShare* share =
      shares.empty() ? nullptr
                     : &shares[static_cast<std::size_t>(chance() * static_cast<Real>(shares.size()))];
  // Light reflected or refracted into a lobe is scattered, and is stored in the map of all light alone.
  // Whitted's tracer, which has no such map, takes the rays that stand for the lobe.
  const bool glossy = lamps_ && isGlossy(at.bsdf());
  const Color mirror = at.mirror(lamps_);
  const Color through =
      share && !glossy ? at.filter(*share) * share->weight * static_cast<Real>(shares.size()) : Color(0);
  const Real mirrors = maxComponent(mirror), passes = maxComponent(through);
  constexpr Real kLeastLobe = 0.2;  // what is scattered is not known beforehand
  const Real likely = body ? scatters(at.bsdf()) * kLeastLobe : std::max(kLeastLobe, 1 - mirrors - passes);
  const Real lobe = scattersIt && !onlyCaustics_ ? likely : 0;
  const Real inBody =
      body && !onlyCaustics_ ? maxComponent(body->albedo) * maxComponent(body->passes(at.cosine)) : 0;
  const Real all = std::max(1.0, mirrors + passes + lobe + inBody), choice = chance() * all;
  Interfaces there = f.inside;
  Vec3 direction;
  if (choice < mirrors) {
    f.gathered = true;
    f.straight = f.asked = false;
    f.power *= mirror * (all / mirrors);
    direction = mirrored(f.ray.direction, at.normal);
  } else if (choice < mirrors + passes) {
    const auto refracted = at.through(*share);
    if (!refracted) return false;
    const bool asked = f.light ? tracer_.lightPasses(at.bsdf()) : tracer_.isPane(at.bsdf());
    f.gathered = f.gathered || !at.straight || !asked;
    // Rays from the eye keep radiance over the square of the index (Veach 1997, section 5.2): so do photons.
    const Real ratio = at.ratio(*share);
    f.straight = f.straight && ratio == 1;
    f.asked = f.asked && asked;
    f.power *= through * (ratio * ratio * all / passes);
    there = at.behind();
    there.wavelength = share->nanometres;
    direction = *refracted;
  } else if (choice < mirrors + passes + lobe) {
    f.straight = f.asked = false;
    f.scattered = true;
    const Real choose = chance();
    const Vec2 u{chance(), chance()};
    const auto drawn = sample(at.bsdf(), at.frame, -f.ray.direction, choose, u, Transport::importance);
    if (!drawn) return false;
    direction = drawn->toLight;
    const bool inward = dot(direction, at.normal) < 0;
    const Color weight = scatteredPhoton(at, direction) * (all / (lobe * drawn->density));
    const Real goes = std::min(1.0, maxComponent(f.power * weight) / maxComponent(f.power));
    if (!(chance() < goes)) return false;
    f.power *= weight / goes;
    if (inward && at.transmits) there = at.behind();
  } else if (choice < mirrors + passes + lobe + inBody) {
    f.straight = f.asked = false;
    f.scattered = true;
    numbers_.next();
    const auto out = departure(at, *body, f.power, Sampler(rules_, numbers_));
    if (!out) return false;
    const Color weight = out->weight * (all / inBody);
    const Real goes = std::min(1.0, maxComponent(f.power * weight) / maxComponent(f.power));
    if (!(chance() < goes)) return false;
    f.power *= weight / goes;
    f.hit = out->hit;
    direction = out->direction;
  } else {
    return false;
  }
  f.law = f.straight && f.light ? fallsOn(f, f.hit->surface.point) : 0;
  f.ray = f.hit->leave(direction);
  f.inside = there;
  const bool intoLobe = choice >= mirrors + passes && choice < mirrors + passes + lobe;
  f.offSurface = intoLobe && at.sendsEvenly();
  return true;
}

}  // namespace trace
