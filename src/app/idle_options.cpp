#include "app/idle_options.h"

#include <algorithm>
#include <string>

#include "render/integrator.h"
#include "render/lamps.h"
#include "render/render.h"
#include "scene/options.h"

namespace trace {
namespace {

template <class Is>
bool anyObject(const World& world, Is&& is) {
  for (std::uint32_t object = 0; object < world.objectCount(); ++object)
    if (!world.shapeOf(object).empty() && is(world.termsOf(object))) return true;
  return false;
}

}  // namespace

void warnOfIdleOptions(const Scene& scene, const Settings& s, const World& world, Messages& messages) {
  const auto warn = [&](const std::string& what, const std::string& hint = {}) {
    messages.warn(Place{.file = scene.file}, what, hint);
  };
  const std::string integrator = findOption("integrator").get(s);
  for (const Option& option : options()) {
    const bool concerned =
        option.integrators == "all" || option.integrators.find(integrator) != option.integrators.npos;
    if (option.extra && !concerned && option.get(s) != option.get({}))
      warn("--" + std::string(option.name) + " changes nothing: it concerns " +
           std::string(option.integrators) + ", and --integrator is " + integrator);
  }

  if (s.noiseTarget > 0 && rowOf(s).byChains)
    warn("--noise-target changes nothing: chains of mlt do not know the error of a pixel");
  else if (s.noiseTarget > 0 && samplesOf(s) <= PixelSum::kFewest)
    warn("--noise-target changes nothing: it looks at a pixel from " + std::to_string(PixelSum::kFewest) +
             " samples on, and --spp gives " + std::to_string(samplesOf(s)),
         "choose a larger --spp, such as 256");

  if (!s.aperturePicture.path.empty() && !(s.aperture > 0))
    warn("--aperture-picture changes nothing: --aperture 0 is a pinhole", "--aperture 0.1 opens the lens");
  if (s.lightChoices > 0 && world.lights().size() < 2)
    warn("--light-choices changes nothing: the scene has fewer than two lights");

  const bool whitted = s.integrator == IntegratorKind::whitted;
  if (whitted && s.caustics > 0) {
    if (world.lights().empty())
      warn("--caustics changes nothing: the scene has no light that sends photons",
           "objects that shine send none; --integrator path follows their light");
    else if (!anyObject(world,
                        [](const WhittedTerms& terms) { return terms.mirrors() || terms.transmits(); }))
      warn("--caustics changes nothing: nothing in the scene mirrors or refracts");
  }
  const auto hasNormals = [&](std::uint32_t object) {
    const MeshTree* mesh = world.meshTree(object);
    return mesh && !mesh->data().normals.empty();
  };
  if (s.smoothTerminator && s.integrator != IntegratorKind::normals) {
    bool any = false;
    for (std::uint32_t i = 0; i < world.objectCount() && !any; ++i) any = hasNormals(i);
    if (!any)
      warn("--smooth-terminator changes nothing: no mesh of the scene has normals at its points",
           "gennormals or crease in a mesh makes them");
  }
  if (whitted && s.caustics == 0 && s.causticTexels > 0)
    warn("--caustic-texels changes nothing: there are no photons to gather", "--caustics 200000 sends some");
  if (whitted && s.lampSamples > 0 && Lamps(world, s.threads).empty())
    warn("--lamp-samples changes nothing: no square, ball or mesh of the scene shines",
         "give an object an emissive color; other shapes that shine light nothing");
  if (whitted && s.ambientOcclusion > 0 && isBlack(world.ambient()))
    warn("--ambient-occlusion changes nothing: the scene has no ambient light");

  if (whitted && s.lampSamples == 0 && world.lights().empty() && !Lamps(world, s.threads).empty() &&
      anyObject(world, [](const WhittedTerms& terms) { return isBlack(terms.emissive); }))
    warn("nothing lights the scene but objects that shine, and for --integrator whitted they light nothing",
         "--lamp-samples 4 lets them; --integrator path follows their light further");

  const bool paths = s.integrator == IntegratorKind::path || s.integrator == IntegratorKind::direct ||
                     s.integrator == IntegratorKind::mlt || s.integrator == IntegratorKind::photon;
  if (paths && world.lights().empty() && !world.outside().isSeenBy(RayKind::bounce) &&
      !anyObject(world, [](const WhittedTerms& terms) { return !isBlack(terms.emissive); }))
    warn("--integrator " + integrator +
             " finds no light in the scene: ambient light stands for light that bounces, "
             "and is left out",
         "add a light, an object with emissive, or a background with a gradient");
}

}  // namespace trace
