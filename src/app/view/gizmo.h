// Handles by which a person moves, turns and scales a thing in the view in space: where they are, which one
// the cursor is on, and what dragging it means. Places on the screen are shares of the view, y up.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "math/transform.h"
#include "shading/cameras/camera.h"

namespace trace {

enum class GizmoMode { move, turn, scale };

struct Gizmo {
  static constexpr int kWhole =
      3;  ///< the handle of no axis: in the plane of the screen, or all axes at once
  static constexpr int kHandles = 4;

  GizmoMode mode = GizmoMode::move;
  Vec3 center;
  Real size = 1;               ///< length of the axes
  std::array<Vec3, 3> axes{};  ///< directions, with length 1
};

/// The handles of a thing that is placed so: they move and turn along the axes of the world, and scale along
/// its own. They take a fixed part of the view.
Gizmo gizmoFor(GizmoMode mode, const Affine& placed, const Vec3& center, const CameraFrame& view);

/// The handle as a line through these points.
std::vector<Vec3> handleLine(const Gizmo& gizmo, int handle);

/// The handle whose line is nearest to the place, at most `reach` of the view's height away; -1 if none is.
int handleAt(const Gizmo& gizmo, const CameraFrame& view, const Vec2& place, Real reach);

/// The transform in the world for a handle that was dragged from one place to another; nothing if it means
/// none.
std::optional<Affine> draggedBy(const Gizmo& gizmo, int handle, const CameraFrame& view, const Vec2& from,
                                const Vec2& to);

}  // namespace trace
