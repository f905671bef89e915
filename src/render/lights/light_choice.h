// The lights of the scene that a place samples: all, or some that are chosen at random where they are many.
#pragma once

#include "render/rays/tracer.h"
#include "render/samples/sampler.h"
#include "scene/integrators.h"

namespace trace {

/// How many lights are asked; 0: all.
inline int lightChoices(const Settings& settings, std::size_t lights) {
  constexpr std::size_t kFew = 32;
  if (settings.lightChoices > 0) return settings.lightChoices;
  return lights > kFew && !hasTrait(settings, Trait::asksAllLights) ? 1 : 0;
}

/// A light that a place samples.
struct AskedLight {
  std::uint32_t light;
  Real share = 1;        ///< so many times what it gives counts
  Real probability = 1;  ///< with which it was chosen
  const Sampler& sampler;
  std::uint32_t branch;
  /// By which one of its places is chosen.
  Sampler numbers() const { return sampler.branch(branch); }
};

/// Calls ask(AskedLight) for each light that is asked at a place, whose unit normal on the side that is lit
/// is `normal`, or null in the air.
template <class Ask>
void askLights(const Tracer& tracer, const Vec3& from, const Vec3* normal, const Sampler& sampler,
               const Ask& ask) {
  const World& world = tracer.world();
  const int choices = lightChoices(tracer.settings(), world.lights().size());
  if (choices == 0) {
    for (std::uint32_t i = 0; i < world.lights().size(); ++i) ask(AskedLight{i, 1, 1, sampler, i});
    return;
  }
  const Sampler choosing = sampler.branch(Branch::lightChoice);
  Sampler numbers = choosing;
  const Real first = numbers.next();
  for (int k = 0; k < choices; ++k) {
    const auto chosen = world.lightTree().choose(from, normal, (k + first) / choices);
    if (chosen)
      ask(AskedLight{chosen->light, 1 / (chosen->probability * choices), chosen->probability, choosing,
                     static_cast<std::uint32_t>(k)});
  }
}

}  // namespace trace
