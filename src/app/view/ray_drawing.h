// The rays of one sample as a drawing: seen from the camera and from the side, over a faint rendering.
#pragma once

#include "app/view/drawing.h"
#include "render/picture/explain.h"
#include "render/world/world.h"
#include "scene/scene.h"

namespace trace {

/// `world` was compiled from the scene with the settings. Renders two small pictures of depth 2.
Drawing drawRays(const Scene& scene, const Settings& settings, const World& world, const RayTree& tree);

}  // namespace trace
