// Light through mirrors and glass that the chosen integrator cannot find: what a render and lint warn of.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "render/world/world.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

struct MissingCaustic {
  std::uint32_t light = 0, object = 0;  ///< indices into Scene::lights and Scene::objects
  std::string why, hint;
};

/// The object throws much of the light that it hits on others, gathered: it mirrors or refracts.
bool gathersLight(const World& world, std::uint32_t object, bool byGlassAlone = false);

/// The first light and object whose caustic will be missing, of those pairs of which `counts(light, object)`
/// is true. Paths never hit a light without a size, or one that they do not see, so they bring nothing of
/// its light by mirrors and glass. What glass gathers is missing wherever shadow rays run straight through
/// it.
std::optional<MissingCaustic> missingCaustic(
    const Scene& scene, const Settings& settings, const World& world, bool byGlassAlone,
    const std::function<bool(std::uint32_t light, std::uint32_t object)>& counts);

/// Something of the light arrives at the middle of the object, were nothing in the way.
bool shinesOn(const Scene& scene, const World& world, std::uint32_t light, std::uint32_t object);

}  // namespace trace
