// The handles of the selected object or light in the view in space: drawn over it, dragged with the mouse.
#pragma once

#include <imgui.h>

#include "app/view/orbit_camera.h"

namespace trace::studio {

struct Studio;

/// The rectangle of the view on the screen, and what it shows.
struct SpaceFrame {
  ImVec2 low, size;
  CameraFrame view;
};

/// Takes hold of the handle that the mouse is pressed on, drags it, and lets go. Call it right after the item
/// of the view. True while a handle is held.
bool dragGizmo(Studio& studio, const SpaceFrame& frame);
/// Draws the handles, if something is selected that has any. True if the cursor is on one.
bool drawGizmo(Studio& studio, const SpaceFrame& frame);

}  // namespace trace::studio
