// The walls around a camera that stands in a closed room: an interactive view from outside leaves out those
// of its sides that would hide what is inside.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/view/orbit_camera.h"
#include "math/box.h"
#include "render/world/world.h"

namespace trace {

/// Objects that lie outermost around `inside`, ascending: those first hit by rays that come in from all
/// directions from beyond the frame. None where fewer than three quarters of the rays hit anything, which is
/// no room.
std::vector<std::uint32_t> wallsAround(const World& world, const Vec3& inside, const Box3& frame);

/// Does a plane through `point` with that normal part the eye from the inside of the room? Then a wall there
/// is not shown.
inline bool parts(const Vec3& normal, const Vec3& point, const Vec3& eye, const Vec3& inside) {
  return dot(normal, eye - point) * dot(normal, inside - point) < 0;
}

/// The crossings of the ray that are shown, the nearest first.
std::vector<Found> shownCrossings(const World& world, const Ray& ray, const std::vector<std::uint32_t>& walls,
                                  const Vec3& inside);

/// The nearest thing on the ray that is shown.
std::optional<Found> closestShown(const World& world, const Ray& ray, const std::vector<std::uint32_t>& walls,
                                  const Vec3& inside);

/// The view has the points in it, and the box, in which their rays are, is large in it.
bool showsWell(const CameraFrame& view, const Box3& box, const std::vector<Vec3>& points);

/// Turned about its target, no farther than needed, so that surfaces hide as few of the points as possible.
OrbitCamera inSight(const OrbitCamera& orbit, const std::vector<Vec3>& points, const World& world,
                    const std::vector<std::uint32_t>& walls, const Vec3& inside);

}  // namespace trace
