#include "render/integrator.h"

#include <array>

#include "render/integrators/path.h"
#include "render/integrators/whitted.h"

namespace trace {
namespace {

template <class Kind>
std::unique_ptr<Integrator> make(const Settings&) {
  return std::make_unique<Kind>();
}

constexpr std::array kTable{
    IntegratorRow{IntegratorKind::whitted, "whitted", "recursive ray tracing: shadows, mirrors and glass",
                  make<Whitted>},
    IntegratorRow{IntegratorKind::path, "path", "paths by chance: light that bounces between surfaces",
                  make<PathTracer>},
};

}  // namespace

std::span<const IntegratorRow> integrators() { return kTable; }

std::unique_ptr<const Integrator> makeIntegrator(const World& world, const Settings& settings, Job& job) {
  auto integrator = kTable[static_cast<std::size_t>(settings.integrator)].make(settings);
  integrator->prepare(world, settings, job);
  return integrator;
}

}  // namespace trace
