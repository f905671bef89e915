#include "render/integrators/make_integrator.h"

#include <stdexcept>
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

/// A kind that is forgotten here is a warning of the compiler.
std::unique_ptr<Integrator> made(const Settings& settings) {
  switch (settings.integrator) {
    case IntegratorKind::whitted: return std::make_unique<Whitted>();
    case IntegratorKind::path: return std::make_unique<PathTracer>();
    case IntegratorKind::direct: return std::make_unique<PathTracer>(false);
    case IntegratorKind::bdpt: return std::make_unique<Bidirectional>();
    case IntegratorKind::mlt:
      if (settings.chains == Chains::bdpt) return std::make_unique<Bidirectional>(true);
      return std::make_unique<PathTracer>();
    case IntegratorKind::photon: return std::make_unique<PhotonTracer>();
    case IntegratorKind::occlusion: return std::make_unique<Occlusion>();
    case IntegratorKind::normals: return std::make_unique<Normals>();
    case IntegratorKind::cost: return std::make_unique<Cost>();
  }
  throw std::logic_error("no integrator is of that kind");
}

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
  auto integrator = made(settings);
  if (changesPaths(settings)) refuseForVeach(world, settings);
  integrator->prepare(world, settings, job);
  return integrator;
}

}  // namespace trace
