#include "render/integrator.h"

#include <array>

#include "render/integrators/normals.h"
#include "render/integrators/occlusion.h"
#include "render/integrators/path.h"
#include "render/integrators/whitted.h"

namespace trace {
namespace {

template <class Kind, auto... kArguments>
std::unique_ptr<Integrator> make(const Settings&) {
  return std::make_unique<Kind>(kArguments...);
}

constexpr std::array kTable{
    IntegratorRow{IntegratorKind::whitted, "whitted", "recursive ray tracing: shadows, mirrors and glass",
                  make<Whitted>},
    IntegratorRow{IntegratorKind::path, "path", "paths by chance: light that bounces between surfaces",
                  make<PathTracer, true>},
    IntegratorRow{IntegratorKind::direct, "direct", "path without bounces: lights and lamps straight",
                  make<PathTracer, false>},
    IntegratorRow{IntegratorKind::occlusion, "occlusion", "how open every place is, as of white clay",
                  make<Occlusion>},
    IntegratorRow{IntegratorKind::normals, "normals", "where surfaces face, as colours", make<Normals>},
};

}  // namespace

std::span<const IntegratorRow> integrators() { return kTable; }

std::unique_ptr<const Integrator> makeIntegrator(const World& world, const Settings& settings, Job& job) {
  auto integrator = kTable[static_cast<std::size_t>(settings.integrator)].make(settings);
  integrator->prepare(world, settings, job);
  return integrator;
}

}  // namespace trace
