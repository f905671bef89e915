// The surface that a camera ray sees behind mirrors and clear glass: its pixel shows the texture and the
// edges of that surface, so these guide the removal of noise.
#pragma once

#include <optional>

#include "render/samples/integrator.h"

namespace trace {

/// The first surface that shows itself more than what is behind, on the way of the mirrored or refracted ray
/// that carries more.
struct SeenBehind {
  CameraRay last;  ///< the ray that arrives there; its hit is none where it leaves the scene
  Color passes;    ///< what mirrors and glass leave of the light
  Real distance;   ///< from the eye to the start of that ray
};
/// Nothing where the camera ray itself hits such a surface, or one that sends no ray on.
std::optional<SeenBehind> seenBehind(Tracer& tracer, const CameraRay& camera, const Sampler& sampler);

}  // namespace trace
