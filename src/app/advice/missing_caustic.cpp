#include "app/advice/missing_caustic.h"

#include <algorithm>

#include "scene/integrators.h"

namespace trace {
namespace {

/// Paths may hit the light: it has a size, and they see it.
bool isMet(const Light& light) { return light.visible() && light.hasSize(); }

bool canBeVisible(const Light& light) { return light.type().seen != nullptr; }

std::string reasonOf(const Settings& settings, const Light& light) {
  if (!hasTrait(settings, Trait::bounces))
    return "--integrator " + std::string(rowOf(settings).name) + " follows no light that bounces";
  if (isMet(light)) return "shadow rays run straight through glass";
  if (!light.hasSize()) return "the light has no size, so no path hits it";
  return canBeVisible(light) ? "the light is not visible, so no path hits it"
                             : "paths cannot hit a light of this kind";
}

}  // namespace

bool gathersLight(const World& world, std::uint32_t object, bool byGlassAlone) {
  constexpr Real kMuch = 0.3, kBends = 0.01;
  const WhittedTerms& terms = world.termsOf(object);
  const bool bends = terms.passage != Passage::straight &&
                     (!byGlassAlone || (world.solid(object) && std::abs(terms.index - 1) > kBends));
  const Real refracted = bends ? maxComponent(terms.transmissive) : 0;
  return std::max(byGlassAlone ? 0 : maxComponent(terms.reflective), refracted) >= kMuch;
}

bool shinesOn(const Scene& scene, const World& world, std::uint32_t light, std::uint32_t object) {
  const Vec3 middle = world.boundsOf(object).center();
  const auto arriving = scene.lights[light].light.illuminate(middle, world.rules());
  return isFinite(middle) && arriving && !isBlack(arriving->intensity());
}

std::optional<MissingCaustic> missingCaustic(
    const Scene& scene, const Settings& settings, const World& world, bool byGlassAlone,
    const std::function<bool(std::uint32_t light, std::uint32_t object)>& counts) {
  const Traits traits = traitsOf(settings);
  if (traits.has(Trait::bringsCaustics) || !traits.has(Trait::meetsLamps)) return {};
  const bool direct = !traits.has(Trait::bounces);
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i].light;
    const bool met = isMet(light), straight = settings.glassShadows == GlassShadows::filtered;
    if (met && !direct && !straight) continue;
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
      if (!gathersLight(world, object, byGlassAlone || (met && !direct)) || !counts(i, object)) continue;
      const bool isFew = settings.quality == Quality::draft || settings.quality == Quality::good;
      if (isFew && !met && gathersLight(world, object, true))
        return MissingCaustic{i, object, reasonOf(settings, light), "--quality final shows such caustics"};
      std::string hint =
          "--integrator bdpt or photon shows such caustics, and so does --integrator whitted --caustics "
          "200000";
      if (met)
        hint += "; path finds them with many samples and --glass-shadows black";
      else if (canBeVisible(light) && light.hasSize())
        hint +=
            "; visible = true in the light lets path find them with many samples and --glass-shadows black";
      return MissingCaustic{i, object, reasonOf(settings, light), std::move(hint)};
    }
  }
  return {};
}

}  // namespace trace
