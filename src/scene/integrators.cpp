#include "scene/integrators.h"

#include <array>

namespace trace {
namespace {

/// In the order of the enum.
constexpr std::array kIntegrators = [] {
  using enum Trait;
  using Kind = IntegratorKind;
  return std::array{
      IntegratorRow{Kind::whitted,
                    "whitted",
                    "recursive ray tracing: shadows, mirrors and glass",
                    {asksAllLights, addsAmbient},
                    [](const Settings& s) { return s.caustics > 0; },
                    {bringsCaustics}},
      IntegratorRow{Kind::path,
                    "path",
                    "path tracing: light that bounces between surfaces",
                    {meetsLamps, bounces, scattersInMedia}},
      IntegratorRow{Kind::direct, "direct", "path without bounces: direct light", {meetsLamps}},
      IntegratorRow{Kind::bdpt,
                    "bdpt",
                    "path, joined with paths that start at lights",
                    {meetsLamps, bounces, scattersInMedia, bringsCaustics, joinsEnds, splats}},
      IntegratorRow{Kind::mlt,
                    "mlt",
                    "Metropolis light transport: Markov chains explore paths",
                    {meetsLamps, bounces, scattersInMedia, splats, byChains},
                    [](const Settings& s) { return s.chains == Chains::bdpt; },
                    {bringsCaustics, joinsEnds}},
      IntegratorRow{Kind::photon,
                    "photon",
                    "photon maps",
                    {meetsLamps, bounces, scattersInMedia, bringsCaustics, photons}},
      IntegratorRow{Kind::occlusion, "occlusion", "ambient occlusion, in white clay", {}},
      IntegratorRow{Kind::normals, "normals", "where surfaces face, as colours", {showsData}},
      IntegratorRow{Kind::cost, "cost", "the work of whitted for each pixel, as colours", {showsData}},
  };
}();

template <class Condition>
EnumSet<IntegratorKind> integratorsThat(const Condition& condition) {
  EnumSet<IntegratorKind> set;
  for (const IntegratorRow& row : kIntegrators)
    if (condition(row)) set.add(row.kind);
  return set;
}

}  // namespace

std::span<const IntegratorRow> integrators() { return kIntegrators; }

const IntegratorRow& rowOf(const Settings& settings) {
  return kIntegrators[static_cast<std::size_t>(settings.integrator)];
}

Traits traitsOf(const Settings& settings) {
  const IntegratorRow& row = rowOf(settings);
  return row.when && row.when(settings) ? row.traits | row.more : row.traits;
}

bool hasLightImage(const Settings& settings) {
  return hasTrait(settings, Trait::splats) && !hasTrait(settings, Trait::byChains);
}

bool changesPaths(const Settings& settings) {
  return hasTrait(settings, Trait::byChains) && settings.chains == Chains::veach;
}

EnumSet<IntegratorKind> integratorsWith(Trait trait) {
  return integratorsThat([&](const IntegratorRow& row) { return row.traits.has(trait); });
}

EnumSet<IntegratorKind> everyIntegrator() {
  return integratorsThat([](const IntegratorRow&) { return true; });
}

std::string namesOfIntegrators(const EnumSet<IntegratorKind>& integrators) {
  if (integrators == everyIntegrator()) return "all";
  std::string names;
  for (const IntegratorRow& row : kIntegrators)
    if (integrators.has(row.kind)) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

}  // namespace trace
