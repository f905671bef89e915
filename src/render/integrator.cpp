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

struct Maker {
  IntegratorKind kind;
  std::unique_ptr<Integrator> (*make)(const Settings& settings);
};
/// In the order of the enum.
constexpr std::array kMakers{
    Maker{IntegratorKind::whitted, make<Whitted>},
    Maker{IntegratorKind::path, make<PathTracer, PathTracer::Light::bounced>},
    Maker{IntegratorKind::direct, make<PathTracer, PathTracer::Light::straight>},
    Maker{IntegratorKind::bdpt, make<Bidirectional>},
    Maker{IntegratorKind::mlt, makeForChains},
    Maker{IntegratorKind::photon, make<PathTracer, PathTracer::Light::photons>},
    Maker{IntegratorKind::occlusion, make<Occlusion>},
    Maker{IntegratorKind::normals, make<Normals>},
    Maker{IntegratorKind::cost, make<Cost>},
};
constexpr bool inOrder() {
  for (std::size_t i = 0; i < kMakers.size(); ++i)
    if (static_cast<std::size_t>(kMakers[i].kind) != i) return false;
  return true;
}
static_assert(inOrder());

}  // namespace

std::unique_ptr<const Integrator> makeIntegrator(const World& world, const Settings& settings, Job& job) {
  auto integrator = kMakers[static_cast<std::size_t>(settings.integrator)].make(settings);
  if (changesPaths(settings)) veach::refuseUnknown(world, settings);
  integrator->prepare(world, settings, job);
  return integrator;
}

}  // namespace trace
