// A POV-Ray scene that was read, as a Scene.
#pragma once

#include "formats/pov/pov_reader.h"
#include "scene/scene.h"

namespace trace::pov {

/// Adds what the world holds to the scene. Warns of what Trace does not have.
void addTo(Scene& scene, const World& world, WarningsByKind& warnings);

/// An object of POV-Ray as those of Trace, in POV-Ray's space.
std::vector<Object> objectsOf(const Node& node);

}  // namespace trace::pov
