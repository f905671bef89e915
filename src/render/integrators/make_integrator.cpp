#include "render/integrators/make_integrator.h"

#include <array>
#include <string>

#include "base/error.h"
#include "render/integrators/bdpt.h"
#include "render/integrators/cost.h"
#include "render/integrators/normals.h"
#include "render/integrators/occlusion.h"
#include "render/integrators/photon.h"
#include "render/integrators/whitted.h"

namespace trace {
namespace {

template <class Kind, auto... kArguments>
std::unique_ptr<Integrator> make(const Settings&) {
  return std::make_unique<Kind>(kArguments...);
}

std::unique_ptr<Integrator> makeForChains(const Settings& settings) {
  if (settings.chains == Chains::bdpt) return std::make_unique<Bidirectional>(true);
  return std::make_unique<PathTracer>();
}

struct Maker {
  IntegratorKind kind;
  std::unique_ptr<Integrator> (*make)(const Settings& settings);
};
/// In the order of the enum.
constexpr std::array kMakers{
    Maker{IntegratorKind::whitted, make<Whitted>},
    Maker{IntegratorKind::path, make<PathTracer>},
    Maker{IntegratorKind::direct, make<PathTracer, false>},
    Maker{IntegratorKind::bdpt, make<Bidirectional>},
    Maker{IntegratorKind::mlt, makeForChains},
    Maker{IntegratorKind::photon, make<PhotonTracer>},
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

/// Features that Veach's mutations do not support.
void refuseForVeach(const World& world, const Settings& settings) {
  const auto refuse = [](const std::string& what) {
    throw Error(Fault::usage, "--chains veach does not know " + what, "--chains bdpt and --chains path do");
  };
  if (settings.fog > 0) refuse("fog");
  if (!world.media().empty()) refuse("media inside objects");
  if (world.hasSubsurface()) refuse("subsurface scattering");
  if (world.hasHoles()) refuse("surfaces that are there in part (opacity)");
  if (world.hasShadowless() || world.hasShadowlessLights()) refuse("what casts no shadow (casts_shadow)");
  if (settings.wavelengths > 1) refuse("light that glass splits (--wavelengths)");
  if (settings.outlines > 0) refuse("--outlines");
  if (settings.smoothTerminator) refuse("--smooth-terminator");
  if (settings.stereo != Stereo::off) refuse("pictures of two eyes (--stereo)");
  if (settings.backFaces != BackFaces::both) refuse("--back-faces other than both");
}

}  // namespace

std::unique_ptr<const Integrator> makeIntegrator(const World& world, const Settings& settings, Job& job) {
  auto integrator = kMakers[static_cast<std::size_t>(settings.integrator)].make(settings);
  if (changesPaths(settings)) refuseForVeach(world, settings);
  integrator->prepare(world, settings, job);
  return integrator;
}

}  // namespace trace
