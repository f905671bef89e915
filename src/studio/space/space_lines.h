// The lines of the view in space: lights, the scene's camera, boxes, normals and rays.
#pragma once

#include <array>
#include <vector>

#include "shading/cameras/camera.h"
#include "studio/space/scene_drawer.h"

namespace trace::studio {

struct Studio;

/// The view of the scene's camera: the eye and the corners of a picture plane before it, from the top left,
/// clockwise.
struct Frustum {
  Vec3 eye;
  std::array<Vec3, 4> corners;
};
Frustum frustumOf(const CameraFrame& frame, Real distance);

/// In the coordinates of the model; seen from `eye`, which is in the world's.
std::vector<DrawLine> spaceLines(const Studio& studio, const Frustum& frustum, const Vec3& eye);

}  // namespace trace::studio
