// The lights of the scene that a place samples: all, or some that are chosen at random where they are many.
#pragma once

#include "math/low_discrepancy.h"
#include "math/warp.h"
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

/// A point on a light that a surface point or a medium samples.
struct AskedLight {
  std::uint32_t light;
  Real share;        ///< so many times what it gives counts
  Real probability;  ///< with which the light was chosen
  const Sampler& sampler;
  std::uint32_t branch;  ///< that of the light
  Vec2 point;            ///< two numbers from 0 up to 1, by which the light chooses the point
  std::uint32_t n = 0;   ///< which of the light's points
};

/// Calls ask(AskedLight) for each light that is asked at a place, whose unit normal on the side that is lit
/// is `normal`, or null in the air. A light with a size is asked for so many `points`.
template <class Ask>
void askLights(const Tracer& tracer, const Vec3& from, const Vec3* normal, const Sampler& sampler, int points,
               const Ask& ask) {
  const World& world = tracer.world();
  const auto askOne = [&](AskedLight asked) {
    if (!world.lightHasSize(asked.light)) return ask(asked);
    const Vec2 first = asked.sampler.branch(asked.branch).next2();
    asked.share = asked.share / points;
    for (; asked.n < static_cast<std::uint32_t>(points); ++asked.n) {
      asked.point = rotated(sobolPoint(asked.n), first);
      ask(asked);
    }
  };
  const int choices = lightChoices(tracer.settings(), world.lights().size());
  if (choices == 0) {
    for (std::uint32_t i = 0; i < world.lights().size(); ++i) askOne({i, 1, 1, sampler, i, kCenter});
    return;
  }
  const Sampler choosing = sampler.branch(Branch::lightChoice);
  Sampler numbers = choosing;
  const Real first = numbers.next();
  for (int k = 0; k < choices; ++k) {
    const auto chosen = world.lightTree().choose(from, normal, (k + first) / choices);
    if (chosen)
      askOne({chosen->light, 1 / (chosen->probability * choices), chosen->probability, choosing,
              static_cast<std::uint32_t>(k), kCenter});
  }
}

}  // namespace trace
