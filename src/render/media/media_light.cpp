// The light of lights and lamps that media and fog scatter to a ray.
#include "math/elementary.h"
#include "render/lights/light_choice.h"
#include "render/media/lamp_light.h"
#include "render/rays/fog.h"

namespace trace {

void addLightsAt(Gather& sum, Tracer& tracer, const ScatterPlace& place, const Sampler& numbers) {
  const World& world = tracer.world();
  const Fog fog(tracer.settings());
  askLights(tracer, place.place, nullptr, numbers, 1, [&](const AskedLight& asked) {
    const auto arriving = world.illuminate(asked.light, place.place, asked.point);
    // From beyond all numbers nothing comes.
    if (!arriving || !(dot(arriving->toLight, arriving->toLight) > 0)) return;
    const Ray toLight{place.place, arriving->toLight};
    const Real left = fog.left(toLight, arriving->distance);
    // A light of colour 1 is one of irradiance pi.
    const Real scattered = phase(place.forward, dot(place.ray.direction, arriving->toLight));
    const Color factor = place.share * arriving->intensity() * (kPi * scattered * left * asked.share);
    if (isBlack(factor)) return;
    Color passed(1);
    if (world.lightCastsShadows(asked.light))
      passed = throughBodies(tracer,
                             tracer.visible(place.place, arriving->toLight, arriving->distance, place.inside),
                             toLight, arriving->distance, numbers.branch(Branch::lightMedia, asked.branch));
    sum.addScattered(asked.light, factor, passed, place.medium);
  });
}

void addLampAt(Gather& sum, const ScatterPlace& place, const Lamps& lamps, bool met, const Sampler& numbers) {
  if (lamps.empty()) return;
  Sampler chances = numbers.branch(Branch::scatteredLamp);
  const Real which = chances.next();
  askLamp(
      sum, lamps, place, {which, chances.next2()}, [&] { return chances.next(); },
      [&] { return numbers.branch(Branch::scatteredToLamp); },
      [&](const Lamps::Place& lamp, bool alone) {
        const Real scattered = phase(place.forward, dot(place.ray.direction, lamp.toLight));
        const ChanceTerm chance = weighed(lamp.density, met && !alone ? scattered : 0);
        return LampWeight<ScatteredTerm>{place.share * (scattered / lamp.density),
                                         {place.medium ? &*place.medium : nullptr, chance}};
      });
}

void addMedia(Gather& sum, Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside,
              const Color& ambient, const Lamps* lamps, const Sampler& sampler) {
  const MediumWay way = throughMedia(tracer, ray, t, inside, tracer.settings().fogSamples, Color(1), sampler);
  coverWithMedia(sum, way);
  std::uint32_t number = 0;
  for (const MediumWay::Place& place : way.places) {
    const MediumTerm term{MediumTerm::What::scatters, place.object, place.t, place.forward};
    if (!isBlack(ambient)) sum.add(place.weight, ambient, term);
    const ScatterPlace at{ray, ray.at(place.t), place.weight, place.forward, inside, term};
    const Sampler numbers = sampler.branch(number++);
    addLightsAt(sum, tracer, at, numbers);
    if (lamps) addLampAt(sum, at, *lamps, false, numbers);
  }
}

void addFog(Gather& sum, Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside,
            const Color& ambient, const Lamps* lamps, const Sampler& sampler) {
  const Settings& settings = tracer.settings();
  const Fog fog(settings);
  const World& world = tracer.world();
  if (fog.none() || !isInOpenAir(inside, world)) return;
  const Real stays = -math::expm1(-fog.depth(ray, t));  // scattered fraction along the ray
  if (!(stays > 0)) return;
  sum.cover(Term::Kind::fog, stays);
  const Color scatters = settings.fogColor * stays;
  if (!isBlack(ambient)) sum.add(Term::Kind::fog, scatters, ambient);

  const int places = settings.fogSamples;
  if (places == 0) return;
  const Color share = scatters * (1.0 / places);
  for (int k = 0; k < places; ++k) {
    Sampler numbers = sampler.branch(static_cast<std::uint32_t>(k));
    // Places are the denser the more light comes from there.
    const Real depth = -math::log1p(-stays * ((k + numbers.next()) / places));
    const Vec3 point = ray.at(fog.distance(ray, depth));
    if (!isFinite(point)) continue;
    const ScatterPlace at{ray, point, share, fog.forward(), inside, {}};
    addLightsAt(sum, tracer, at, numbers);
    if (lamps) addLampAt(sum, at, *lamps, false, numbers);
  }
}

}  // namespace trace
