// THE table of integrators: their names, and their traits, by which the rest of the program decides what an
// integrator needs. render/integrators/make_integrator.cpp makes them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scene/settings.h"

namespace trace {

/// A property of an integrator. tests/render/traits_test.cpp holds each to the pictures.
enum class Trait {
  asksAllLights,    ///< samples all lights at each hit point; others choose one where there are many
  addsAmbient,      ///< adds the ambient light, which stands for indirect light
  meetsLamps,       ///< emissive objects and the environment are lights: sampled, and hit by scattered rays
  bounces,          ///< traces indirect light: what a surface scatters lights other surfaces
  scattersInMedia,  ///< traces light that fog and media scatter several times
  bringsCaustics,   ///< traces light that glass refracts, so that shadow rays do not pass that glass
  joinsEnds,        ///< connects paths from the camera with paths from lights
  splats,           ///< its samples add light to any pixel
  byChains,         ///< Markov chains choose the samples: a pixel has none of its own
  photons,          ///< estimates indirect light by photon maps
  showsData,        ///< its colours are data, such as normals, and no light
};
using Traits = EnumSet<Trait>;

struct IntegratorRow {
  IntegratorKind kind;
  std::string_view name;
  std::string_view help;
  Traits traits;
  bool (*when)(const Settings& settings) = nullptr;  ///< options that add `more`; null: none do
  Traits more = {};
};

std::span<const IntegratorRow> integrators();
const IntegratorRow& rowOf(const Settings& settings);

/// The traits of the integrator with its options.
Traits traitsOf(const Settings& settings);
inline bool hasTrait(const Settings& settings, Trait trait) { return traitsOf(settings).has(trait); }

/// Paths from lights form a picture of their own, which is added to that of the pixels' samples.
bool hasLightImage(const Settings& settings);

/// The chains change the vertices of paths, not the random numbers of a sample.
bool changesPaths(const Settings& settings);

/// The integrators that have the trait whatever the options are.
EnumSet<IntegratorKind> integratorsWith(Trait trait);
EnumSet<IntegratorKind> everyIntegrator();
/// "all", or names such as "whitted, photon".
std::string namesOfIntegrators(const EnumSet<IntegratorKind>& integrators);

}  // namespace trace
