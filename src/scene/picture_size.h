// The settings of a scene with layers of choices above its own, and the picture's size among them.
#pragma once

#include <initializer_list>
#include <span>

#include "scene/options.h"
#include "scene/scene.h"
#include "shading/cameras/camera.h"

namespace trace {

/// resolve() of the layers, of which the first is the scene's own. Where a layer above it gives only one of
/// width and height, the other follows: the picture keeps the shape that it has without that layer. Both are
/// taken as they are where a layer gives both, and in the scene's own.
/// Throws Error as resolve() does, and Error(Fault::limit) for a side that would be too long.
Settings settingsFor(const Camera& camera, std::initializer_list<std::span<const Choice>> layers);

/// The scene's camera for the picture of these settings: with FreeAspect, the one of its shape.
Camera cameraFor(const Scene& scene, const Settings& settings);

}  // namespace trace
