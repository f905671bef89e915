#include "render/fog.h"

#include <algorithm>
#include <cmath>

#include "render/light_choice.h"

namespace trace {
namespace {

/// So many heights down the density where the ray starts counts for nothing, and may be 0 by rounding.
constexpr Real kFarDown = 30;

}  // namespace

Real Fog::densityAt(const Vec3& point) const {
  constexpr Real kMost = 50;  // of the exponent, far below
  return height_ > 0 ? density_ * std::exp(std::min(-point.y / height_, kMost)) : density_;
}

Real Fog::depth(const Ray& ray, Real t) const {
  if (none()) return 0;
  const Real here = densityAt(ray.origin);
  const Real thinner = height_ > 0 ? ray.direction.y / height_ : 0;  // the rate along the ray
  if (thinner == 0) return here == 0 ? 0 : here * t;
  if (-thinner * t > kFarDown) return t < kInfinity ? (here - densityAt(ray.at(t))) / thinner : kInfinity;
  return here * (-std::expm1(-thinner * t) / thinner);  // the integral of exp(-thinner s)
}

Real Fog::distance(const Ray& ray, Real depth) const {
  const Real here = densityAt(ray.origin);
  const Real thinner = height_ > 0 ? ray.direction.y / height_ : 0;
  if (thinner == 0) return depth / here;
  const Real change = thinner * depth;
  if (!(here > change)) return kInfinity;
  if (-change > here * std::exp(kFarDown))  // by the height at which it is so dense
    return (-height_ * std::log((here - change) / density_) - ray.origin.y) / ray.direction.y;
  return -std::log1p(-change / here) / thinner;
}

Real Fog::phase(const Vec3& direction, const Vec3& toLight) const {
  const Real g = forward_, cosine = dot(direction, toLight);
  const Real base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * kPi * base * std::sqrt(base));
}

void coverWithFog(Gather& sum, const Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside) {
  const Fog fog(tracer.settings());
  if (!fog.none() && isInOpenAir(inside, tracer.world()))
    sum.cover(Term::Kind::fog, -std::expm1(-fog.depth(ray, t)));
}

void addFog(Gather& sum, Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside,
            const Color& ambient, const Lamps* lamps, const Sampler& sampler) {
  const Settings& settings = tracer.settings();
  const Fog fog(settings);
  const World& world = tracer.world();
  if (fog.none() || !isInOpenAir(inside, world)) return;
  const Real stays = -std::expm1(-fog.depth(ray, t));  // of what comes along the ray
  if (!(stays > 0)) return;
  sum.cover(Term::Kind::fog, stays);
  const Color scatters = settings.fogColor * stays;
  if (!isBlack(ambient)) sum.add(Term::Kind::fog, scatters, ambient);

  constexpr std::uint32_t kLamp = 0x80000000u;  // the branch beside those of the lights
  const int places = settings.fogSamples;
  const Color share = scatters * (1.0 / places);
  for (int k = 0; k < places; ++k) {
    Sampler numbers = sampler.branch(static_cast<std::uint32_t>(k));
    // Places are the denser the more light comes from there.
    const Real depth = -std::log1p(-stays * ((k + numbers.next()) / places));
    const Vec3 point = ray.at(fog.distance(ray, depth));
    if (!isFinite(point)) continue;
    askLights(tracer, point, nullptr, numbers, [&](const AskedLight& asked) {
      const Vec2 place = world.lightHasSize(asked.light) ? asked.numbers().next2() : kCenter;
      const auto arriving = world.illuminate(asked.light, point, place);
      // From beyond all numbers nothing comes.
      if (!arriving || !(dot(arriving->toLight, arriving->toLight) > 0)) return;
      const Real left = fog.left({point, arriving->toLight}, arriving->distance);
      // A light of colour 1 is one of irradiance pi.
      const Color factor = share * arriving->intensity() *
                           (kPi * fog.phase(ray.direction, arriving->toLight) * left * asked.share);
      if (!isBlack(factor))
        sum.add(Term::Kind::fog, factor,
                tracer.visible(point, arriving->toLight, arriving->distance, inside));
    });
    if (!lamps || lamps->empty()) continue;
    Sampler chances = numbers.branch(kLamp);
    const Real which = chances.next();
    if (const auto lamp = lamps->choose(point, which, chances.next2())) {
      const Color seen = lamps->look(tracer, {point, lamp->toLight}, *lamp, inside, tracer.chance(chances));
      sum.add(Term::Kind::fog, share * (fog.phase(ray.direction, lamp->toLight) / lamp->density), seen);
    }
  }
}

}  // namespace trace
