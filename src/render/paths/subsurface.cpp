#include "render/paths/subsurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "shading/materials/subsurface.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/optics.h"

namespace trace {
namespace {

using PerColor = std::array<Real, 3>;
PerColor channels(const Color& c) { return {c.r, c.g, c.b}; }
Color color(const PerColor& c) { return {c[0], c[1], c[2]}; }

/// The parts of all that each colour counts; equal where none counts.
PerColor shares(const Color& counts) {
  const Real all = counts.r + counts.g + counts.b;
  return all > 0 ? channels(counts / all) : PerColor{1. / 3, 1. / 3, 1. / 3};
}
std::size_t chosenChannel(const PerColor& shares, Real u) {
  return u < shares[0] ? 0 : u < shares[0] + shares[1] ? 1 : 2;
}

/// Coefficients along a unit of the scene.
PerColor perUnit(const Color& perMillimetre, const Subsurface& said) {
  return channels(perMillimetre * said.millimetres);
}

/// The surface that the tracer has hit there, seen from outside.
std::optional<Entrance> seen(Tracer& tracer, const Vec3& from, const Ray& foundOn, const Found& found,
                             const Color& weight, const BodyTerm& how) {
  const SurfacePoint place = tracer.world().surface(foundOn, found);
  const Vec3 outward = place.normal;
  // Recorded is the way from the one place to the other.
  Hit hit = tracer.meet(foundOn, RayKind::refraction, found);
  if (tracer.records()) tracer.drawFrom(from, place.point);
  hit.leaving = false;
  return Entrance{hit, {place.point + outward, -outward}, weight, how};
}

// --- profiles -----------------------------------------------------------------------------------------

template <class Profile>
std::optional<Entrance> byProfile(const Interaction& at, const std::array<Profile, 3>& profiles,
                                  const Color& importance, Sampler& numbers) {
  Tracer& tracer = at.tracer;
  const World& world = tracer.world();
  const SurfacePoint& here = at.hit.surface;
  PerColor counts = channels(importance);
  for (std::size_t c = 0; c < 3; ++c) counts[c] *= profiles[c].albedo;
  const PerColor share = shares(color(counts));

  const Basis basis = Frame{here.normal}.basis();
  const std::array<Vec3, 3> axes{basis.z, basis.x, basis.y};
  constexpr std::array<Real, 3> kShareOfAxis{0.7, 0.15, 0.15};
  const Real u = numbers.next();
  const std::size_t axis = u < 0.7 ? 0 : u < 0.85 ? 1 : 2;
  const Vec3 &along = axes[axis], &across = axes[(axis + 1) % 3], &aside = axes[(axis + 2) % 3];
  const std::size_t channel = chosenChannel(share, numbers.next());
  const Vec2 disk = numbers.next2();
  const Real r = profiles[channel].distance(disk.x);
  const math::SinCos phi = math::sincos(2 * kPi * disk.y);
  const Vec3 middle = here.point + (across * phi.cos + aside * phi.sin) * r;

  // The line from one side of the body to the other; of an infinite one, as far as light gets.
  const Box3 box = world.boundsOf(at.hit.object);
  Real half = 0;
  if (box.empty()) {
    for (const Profile& profile : profiles) half = std::max(half, profile.distance(1 - 1e-6));
  } else {
    half = length(box.size()) + length(middle - box.center());
  }
  const Ray probe{middle - along * half, along};
  std::vector<Found> met;
  world.crossingsOf(at.hit.object, probe, 2 * half, tracer.statistics(), [&](const Found& found) {
    met.push_back(found);
    return false;
  });
  if (met.empty()) return {};
  std::sort(met.begin(), met.end(), [](const Found& a, const Found& b) { return a.before(b); });
  met.erase(std::unique(met.begin(), met.end(),
                        [](const Found& a, const Found& b) { return !a.before(b) && !b.before(a); }),
            met.end());
  // One of the places on the line is taken, as often as it weighs.
  struct Place {
    Color weight;
    Real distance, counts;
  };
  std::vector<Place> places;
  Real all = 0;
  for (const Found& crossing : met) {
    const SurfacePoint there = world.surface(probe, crossing);
    const Vec3 away = there.point - here.point;
    Real density = 0;  // per area, by all axes and colours
    for (std::size_t a = 0; a < 3; ++a) {
      const Real facing = std::abs(dot(there.normal, axes[a]));
      const Real from = length(away - axes[a] * dot(away, axes[a]));
      for (std::size_t c = 0; c < 3; ++c)
        if (share[c] > 0)
          density += kShareOfAxis[a] * share[c] * facing * profiles[c].profile(from) / profiles[c].albedo;
    }
    const Real distance = length(away);
    PerColor weight{};
    if (density > 0)
      for (std::size_t c = 0; c < 3; ++c) weight[c] = profiles[c].profile(distance) / density;
    const Color found = isFinite(color(weight)) ? color(weight) : Color(0);
    const Color counted = found * importance;
    places.push_back({found, distance, counted.r + counted.g + counted.b});
    all += places.back().counts;
  }
  if (!(all > 0)) return {};
  Real rest = numbers.next() * all;
  std::size_t taken = 0;
  while (taken + 1 < places.size() && rest >= places[taken].counts) rest -= places[taken++].counts;
  const Place& place = places[taken];
  if (!(place.counts > 0)) return {};
  return seen(tracer, here.point, probe, met[taken], place.weight * (all / place.counts),
              {place.distance, 0});
}

// --- the walk -----------------------------------------------------------------------------------------

/// Where a walk comes to the surface and is let out.
struct WalkEnd {
  Ray ray;
  Found wall;
  SurfacePoint place;
  Real letOut;  ///< transmittance to the outside
  Color weight;
  int steps;
};

/// The walk of light that starts in the body along that ray.
std::optional<WalkEnd> walked(const Interaction& at, const Subsurface& said, Ray ray, const Color& importance,
                              Sampler& numbers) {
  constexpr int kMostSteps = 100000, kSurely = 16;
  Tracer& tracer = at.tracer;
  const World& world = tracer.world();
  const PerColor scatters = perUnit(said.scatters, said), absorbs = perUnit(said.absorbs, said);
  PerColor loses;
  for (std::size_t c = 0; c < 3; ++c) loses[c] = scatters[c] + absorbs[c];

  Color weight(1);
  for (int steps = 0; steps < kMostSteps; ++steps) {
    std::optional<Found> wall;
    world.crossingsOf(at.hit.object, ray, kInfinity, tracer.statistics(), [&](const Found& found) {
      if (!wall || found.before(*wall)) wall = found;
      return false;
    });
    if (!wall) return {};  // the body is open there
    const PerColor share = shares(importance * weight);
    const std::size_t channel = chosenChannel(share, numbers.next());
    const Real s = -math::log1p(-numbers.next()) / loses[channel], t = std::min(s, wall->t);
    PerColor passes;
    Real all = 0;
    const bool scattered = s < wall->t;
    for (std::size_t c = 0; c < 3; ++c) {
      passes[c] = math::exp(-loses[c] * t);
      all += share[c] * passes[c] * (scattered ? loses[c] : 1);
    }
    if (!(all > 0)) return {};
    weight = weight * color(passes) * (scattered ? color(scatters) : Color(1)) / all;
    if (scattered) {
      if (steps > kSurely) {
        const Real goes = std::min(1.0, maxComponent(importance * weight) / maxComponent(importance));
        if (!(numbers.next() < goes)) return {};
        weight = weight / goes;
      }
      const Vec2 u = numbers.next2();
      ray = {ray.at(s), sphericalDirection(1 - 2 * u.x, 2 * kPi * u.y)};
      continue;
    }
    const SurfacePoint place = world.surface(ray, *wall);
    const Real cosine = std::abs(dot(ray.direction, place.normal));
    const Real mirrors = fresnelDielectric(cosine, said.index, 1);
    if (!(numbers.next() < mirrors)) return WalkEnd{ray, *wall, place, 1 - mirrors, weight, steps};
    ray = spawnRay(place, mirrored(ray.direction, place.normal));
  }
  return {};
}

std::optional<Entrance> byWalk(const Interaction& at, const Subsurface& said, const Color& importance,
                               Sampler& numbers) {
  const SurfacePoint& here = at.hit.surface;
  const auto inward = refracted(at.ray.direction, at.normal, 1 / said.index);
  if (!inward || !(dot(*inward, here.normal) < 0)) return {};
  const auto end = walked(at, said, spawnRay(here, *inward), importance, numbers);
  if (!end) return {};
  return seen(at.tracer, here.point, end->ray, end->wall, end->weight,
              {length(end->place.point - here.point), end->steps});
}

/// By a walk or a profile; without what the surface lets out.
std::optional<Entrance> found(const Interaction& at, const Subsurface& said, const Color& importance,
                              Sampler& numbers) {
  if (said.spreading == Spreading::walk) return byWalk(at, said, importance, numbers);
  const PerColor scatters = perUnit(said.scatters, said), absorbs = perUnit(said.absorbs, said);
  std::array<Dipole, 3> dipoles;
  std::array<NormalizedDiffusion, 3> others;
  for (std::size_t c = 0; c < 3; ++c) {
    dipoles[c] = {scatters[c], absorbs[c], said.index};
    others[c] = {scatters[c], absorbs[c], dipoles[c].albedo};
  }
  return said.spreading == Spreading::dipole ? byProfile(at, dipoles, importance, numbers)
                                             : byProfile(at, others, importance, numbers);
}

}  // namespace

std::optional<Entrance> entrance(const Interaction& at, const SubsurfaceBsdf& body, const Color& importance,
                                 Sampler numbers) {
  auto in = found(at, body.said, importance, numbers);
  if (in) in->weight *= body.passes(at.cosine);
  return in;
}

std::optional<Departure> departure(const Interaction& at, const SubsurfaceBsdf& body, const Color& power,
                                   Sampler numbers) {
  const Subsurface& said = body.said;
  const SurfacePoint& here = at.hit.surface;
  // Photons are spread over the true area, and light counts by the shaded one (Veach 1997, section 5.3.2).
  constexpr Real kMost = 4;
  if (!(at.cosine > 0 && at.facing() > 0)) return {};
  const Color goesIn = body.enters(at.cosine) * std::min(at.cosine / at.facing(), kMost);
  const auto left = [&](const std::optional<Entrance>& place, const Vec3& direction,
                        const Color& weight) -> std::optional<Departure> {
    if (!place || !(dot(direction, place->hit.surface.shading) > 0)) return {};
    return Departure{place->hit, direction, goesIn * place->weight * weight};
  };
  if (said.spreading != Spreading::walk) {
    const auto place = found(at, said, power * goesIn, numbers);
    if (!place) return {};
    const SurfacePoint& there = place->hit.surface;
    const Vec3 direction = Frame{there.normal}.basis().toWorld(cosineDirection(numbers.next2()));
    return left(place, direction, body.passes(dot(direction, there.shading)));
  }
  const Vec3 inward = Frame{-here.normal}.basis().toWorld(cosineDirection(numbers.next2()));
  const Real enters = 1 - fresnelDielectric(-dot(inward, here.normal), said.index, 1);
  if (!(enters > 0)) return {};
  const auto end = walked(at, said, spawnRay(here, inward), power * goesIn, numbers);
  if (!end) return {};
  const auto direction = refracted(end->ray.direction, -end->place.normal, said.index);
  if (!direction) return {};
  const auto place = seen(at.tracer, here.point, end->ray, end->wall, end->weight, {});
  const Color lets = body.passes(dot(*direction, place->hit.surface.shading));
  return left(place, *direction, lets * (enters * said.index * said.index / end->letOut));
}

}  // namespace trace
