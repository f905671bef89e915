// The surface-of-revolution mesh of the courses' modeler project: a profile curve turned about the y axis.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/model.h"
#include "geometry/mesh/mesh.h"
#include "math/vec.h"

namespace trace {

/// A profile: one point "x y" a line, x the distance from the axis and y the height; # starts a comment.
/// Throws Error(Fault::scene) for fewer than two points, or a negative distance.
std::vector<Vec2> readProfile(const std::string& file, std::string_view text);

/// The mesh of the profile turned about the y axis in `steps` steps, with normals and uv: u goes once around,
/// v along the profile by its length. The outside is the right-hand side of the profile, as it goes up.
/// Precondition: steps >= 3, at least two points.
MeshData revolve(std::span<const Vec2> profile, int steps);

/// The profile's mesh as a scene of its own, with the picture of that file on it if the name is not empty:
/// once around, and once along the profile. Throws Error(Fault::io) for a picture that cannot be read.
Scene revolvedScene(const std::string& file, std::string_view text, int steps, const std::string& picture,
                    Messages& messages);

}  // namespace trace
