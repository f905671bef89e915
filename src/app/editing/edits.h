// Changes that follow when a person has set one field of a struct of the scene by hand.
#pragma once

#include <optional>
#include <string_view>

#include "shading/background.h"
#include "shading/cameras/camera.h"
#include "shading/materials/phong.h"
#include "shading/texture.h"

namespace trace {

/// Called with what the struct was before.
template <class Struct>
void followEdit(Struct&, const Struct&, std::string_view) {}

/// Whole numbers in a scene's file are at most this, and at least minus this.
double mostWhole();

/// A mirror that a person has set no longer follows the highlight.
void followEdit(Phong& now, const Phong& before, std::string_view keyword);

/// A camera that the file says looks at a point continues doing so when it is moved.
void followMove(Camera& now, std::string_view keyword, const std::optional<Vec3>& lookAt);

/// The first colours of a ramp are a and b, which it takes the place of.
void followEdit(TextureModel& now, const TextureModel& before, std::string_view keyword);

/// Keeps a background sound: ascending limits, one less than colours, or none. Bands that are added get
/// limits of their own; who takes a limit out wants equal bands again. Elevations ascend, one for each colour
/// of the gradient, or there are none.
void followEdit(Background& now, const Background& before, std::string_view keyword);

}  // namespace trace
