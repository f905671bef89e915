// Participating media between surfaces: fog in the air, and objects filled with a medium. The light that is
// left of what comes along a ray, what the media emit on the way, and the places where they scatter light
// to it.
//
// Media that are the same everywhere are computed by Beer's law. Where a density changes, the way is
// cut at random into steps as short as its greatest density asks, and each step takes its part (ratio
// tracking: Novak, Selle and Jarosz, Residual Ratio Tracking, SIGGRAPH Asia 2014; delta tracking: Woodcock
// and others 1965). Every step is also a place that might scatter; of all these some are chosen by what they
// weigh. Where nothing is absorbed, that is what delta tracking chooses: weights of 1. Colours are chosen
// from together, by what each would choose (Chiang and others, Practical and Controllable Subsurface
// Scattering, SIGGRAPH 2016 talks), so no weight grows out of bounds.
#pragma once

#include <optional>
#include <vector>

#include "render/lights/lamps.h"
#include "render/maps/photon_map.h"
#include "render/rays/gather.h"
#include "render/samples/sampler.h"

namespace trace {

/// Some medium may lie on a ray's way.
inline bool isThick(const Tracer& tracer) {
  return !tracer.world().media().empty() || tracer.settings().fog > 0;
}

/// The way of a ray through media.
struct MediumWay {
  Color passes{1};  ///< transmittance to its end
  Color glows;      ///< what arrives of the light that they emit
  /// Where light is scattered to the ray.
  struct Place {
    Real t;
    Color weight;  ///< weight of the light there, from all directions
    Real forward;
    std::uint32_t object;  ///< whose medium it is; Filling::kAir for fog
    Color arrives;         ///< the length for which it stands, without what the medium scatters of it
  };
  std::vector<Place> places;
};

/// Follows the ray through the media of `inside` up to t, which may be infinite. So many places are chosen;
/// light to lamps wants none. `importance` says how much each colour counts. What is in the air counts only
/// with `fog`.
MediumWay throughMedia(Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside, int places,
                       const Color& importance, Sampler numbers, bool fog = true);

/// Whether a path that arrives with that weight is scattered at the place of the way, by a number from 0 up
/// to 1: then the place, which counts the more; else the rest counts the more.
std::optional<MediumWay::Place> placeByChance(MediumWay& way, const Color& weight, Real chance);

/// A direction in which a medium scatters what ran along `along`, by two numbers from 0 up to 1.
struct PhaseSample {
  Vec3 direction;
  Real density;  ///< per solid angle: the phase function there
};
PhaseSample samplePhase(const Vec3& along, Real forward, const Vec2& u);

/// Adds what `way` lets pass and emits to the sum of what comes from its end.
void coverWithMedia(Gather& sum, const MediumWay& way);

/// The part of `passed` of the last shadow ray that media inside objects transmit. Fog is
/// known already.
Color throughBodies(Tracer& tracer, const Color& passed, const Ray& toLight, Real distance, Sampler numbers);
/// The transmittance of a ray to an emitter; `first` becomes the first body on the way.
Color passedByBodies(Tracer& tracer, const Ray& ray, Real distance, Sampler numbers,
                     std::uint32_t* first = nullptr);

/// How light that is scattered at a point of the ray is asked for.
struct ScatterPlace {
  const Ray& ray;
  Vec3 place;
  Color share;  ///< share of that light in the sum
  Real forward;
  const Interfaces& inside;
  std::optional<MediumTerm> medium;  ///< none in fog alone

  const Vec3& point() const { return place; }
  Ray leave(const Vec3& direction) const { return {place, direction}; }
  const Interfaces& side(const Vec3&) const { return inside; }
};
/// Adds the light of the photons around, of a place that a medium has.
void addPhotonsAt(Gather& sum, const ScatterPlace& place, const PhotonMap& photons, const Sampler& numbers);
/// Adds the light of the scene's lights.
void addLightsAt(Gather& sum, Tracer& tracer, const ScatterPlace& place, const Sampler& numbers);
/// Adds the light of one place on emissive objects. `met`: a ray that is scattered there may hit them,
/// too.
void addLampAt(Gather& sum, const ScatterPlace& place, const Lamps& lamps, bool met, const Sampler& numbers);

/// Covers what has been summed with the media before it and adds the light that is scattered there once, of
/// the lights and of what comes from everywhere: Whitted's equation.
void addMedia(Gather& sum, Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside,
              const Color& ambient, const Lamps* lamps, const Sampler& sampler);

/// Covers what has been summed with the fog before it, and adds the light of the scene's lights in that fog:
/// of the ray that ran on to t, which may be infinite, in `inside`. `ambient` is light from everywhere;
/// `lamps`, if any, are emissive objects.
void addFog(Gather& sum, Tracer& tracer, const Ray& ray, Real t, const Interfaces& inside,
            const Color& ambient, const Lamps* lamps, const Sampler& sampler);

}  // namespace trace
