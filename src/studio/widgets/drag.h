// Dragging with the mouse.
#pragma once

#include <imgui.h>

namespace trace::studio {

/// How far the mouse has dragged in this frame, that button being down. A frame that takes long holds the way
/// to the place of the press as well, which is no part of the drag.
inline ImVec2 dragged(ImGuiMouseButton button) {
  return ImGui::IsMouseClicked(button) ? ImVec2{0, 0} : ImGui::GetIO().MouseDelta;
}

/// Called after a widget that drags `value`, which is no part of the scene: Esc gives back the value that it
/// had before.
template <class Value>
void escapable(Value& value) {
  static Value before;  // one widget is held at a time
  if (ImGui::IsItemActivated()) before = value;
  if (ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) value = before;
}

}  // namespace trace::studio
