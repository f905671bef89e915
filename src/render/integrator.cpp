#include "render/integrator.h"

#include <array>

#include "render/integrators/bdpt.h"
#include "render/integrators/cost.h"
#include "render/integrators/normals.h"
#include "render/integrators/occlusion.h"
#include "render/integrators/path.h"
#include "render/integrators/whitted.h"
#include "render/veach_path.h"

namespace trace {
namespace {

template <class Kind, auto... kArguments>
std::unique_ptr<Integrator> make(const Settings&) {
  return std::make_unique<Kind>(kArguments...);
}

std::unique_ptr<Integrator> makeForChains(const Settings& settings) {
  if (settings.chains == Chains::bdpt) return std::make_unique<Bidirectional>(true);
  return std::make_unique<PathTracer>(PathTracer::Light::bounced);
}

constexpr std::array kIntegrators{
    IntegratorRow{IntegratorKind::whitted, "whitted", "recursive ray tracing: shadows, mirrors and glass",
                  make<Whitted>},
    IntegratorRow{IntegratorKind::path, "path", "path tracing: light that bounces between surfaces",
                  make<PathTracer, PathTracer::Light::bounced>},
    IntegratorRow{IntegratorKind::direct, "direct", "path without bounces: direct light",
                  make<PathTracer, PathTracer::Light::straight>},
    IntegratorRow{IntegratorKind::bdpt, "bdpt", "path, joined with paths that start at lights",
                  make<Bidirectional>, false, true},
    IntegratorRow{IntegratorKind::mlt, "mlt", "Metropolis light transport: Markov chains explore paths",
                  makeForChains, true, true},
    IntegratorRow{IntegratorKind::photon, "photon", "photon maps",
                  make<PathTracer, PathTracer::Light::photons>},
    IntegratorRow{IntegratorKind::occlusion, "occlusion", "ambient occlusion, in white clay",
                  make<Occlusion>},
    IntegratorRow{IntegratorKind::normals, "normals", "where surfaces face, as colours", make<Normals>},
    IntegratorRow{IntegratorKind::cost, "cost", "the work of whitted for each pixel, as colours", make<Cost>},
};

}  // namespace

std::span<const IntegratorRow> integrators() { return kIntegrators; }

const IntegratorRow& rowOf(const Settings& settings) {
  return kIntegrators[static_cast<std::size_t>(settings.integrator)];
}

std::unique_ptr<const Integrator> makeIntegrator(const World& world, const Settings& settings, Job& job) {
  auto integrator = rowOf(settings).make(settings);
  if (changesPaths(settings)) veach::refuseUnknown(world, settings);
  integrator->prepare(world, settings, job);
  return integrator;
}

}  // namespace trace
