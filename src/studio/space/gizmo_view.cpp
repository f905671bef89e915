#include "studio/space/gizmo_view.h"

#include <cmath>
#include <string>

#include "app/editing/placing.h"
#include "formats/ray/write/transform.h"
#include "studio/scene/selection.h"
#include "studio/space/rays_view.h"
#include "studio/studio.h"

namespace trace::studio {
namespace {

constexpr float kReach = 7;  // pixels from a handle that count as on it

/// The selected object, or the selected light that has a place.
struct Held {
  std::string name;
  Affine placed;
  Vec3 center;
};

/// The middle of the object's parts.
std::optional<Vec3> centerOf(const SceneModel& model, std::size_t object) {
  Box3 box;
  for (const ScenePart& part : model.parts)
    if (part.object == object)
      for (const Vec3& corner : part.box) box.extend(corner);
  if (box.empty()) return {};
  return box.center();
}

std::optional<Held> selectedThing(const Studio& studio) {
  const Scene& scene = studio.workspace.document.scene();
  const std::size_t index = studio.selectedIndex;
  if (studio.selected == Studio::Selected::object && index < scene.objects.size()) {
    const Object& object = scene.objects[index];
    const auto center = centerOf(studio.rays.model, index);
    if (!center) return {};
    return Held{entryName(object), object.worldFromObject, *center};
  }
  if (studio.selected == Studio::Selected::light && index < scene.lights.size())
    if (const Vec3* position = scene.lights[index].light.position())
      return Held{entryName(scene.lights[index]), Affine::translation(*position), *position};
  return {};
}

/// The cursor as a share of the view, y up.
Vec2 cursorIn(const SpaceFrame& frame) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {(mouse.x - frame.low.x) / frame.size.x, 1 - (mouse.y - frame.low.y) / frame.size.y};
}

Gizmo gizmoOf(const Studio& studio, const Held& held, const CameraFrame& view) {
  const bool light = studio.selected == Studio::Selected::light;
  return gizmoFor(light ? GizmoMode::move : studio.rays.gizmo.mode, held.placed, held.center, view);
}

/// A scaled object keeps its foot where it is.
Affine standing(const Studio& studio, const Affine& before, const Affine& placed) {
  const Scene& scene = studio.workspace.document.scene();
  if (studio.selected != Studio::Selected::object || studio.selectedIndex >= scene.objects.size())
    return placed;
  Object object = scene.objects[studio.selectedIndex];
  object.worldFromObject = before;
  const Box3 was = boxOf(object);
  object.worldFromObject = placed;
  return withoutNoise(onItsFoot(was, placed, boxOf(object), scene.camera.updir));
}

void place(Studio& studio, const Affine& placed) {
  if (!keepsObject(placed)) return;
  Scene scene = studio.workspace.document.scene();
  const std::size_t index = studio.selectedIndex;
  std::string name;
  if (studio.selected == Studio::Selected::object) {
    Object& object = scene.objects[index];
    if (object.worldFromObject == placed) return;
    object.worldFromObject = placed;
    name = entryName(object);
  } else {
    Vec3* position = editableValue<Vec3>(scene.lights[index].light, "position");
    if (!position || *position == placed.offset) return;
    *position = placed.offset;
    name = entryName(scene.lights[index]);
  }
  constexpr const char* kVerbs[] = {"move ", "turn ", "scale "};
  const unsigned id = ImGui::GetID("gizmo");
  const bool continues = studio.editedItem == id;  // one step for each time that a handle is held
  studio.editedItem = id;
  studio.workspace.edit(kVerbs[static_cast<int>(studio.rays.gizmo.held->mode)] + name, std::move(scene),
                        continues);
}

}  // namespace

bool dragGizmo(Studio& studio, const SpaceFrame& frame) {
  GizmoHold& gizmo = studio.rays.gizmo;
  if (!ImGui::IsMouseDown(0)) gizmo.held.reset();
  if (ImGui::IsItemActivated() && ImGui::IsMouseClicked(0) && !ImGui::GetIO().KeyShift) {
    if (const auto thing = selectedThing(studio)) {
      const Gizmo there = gizmoOf(studio, *thing, frame.view);
      const int handle =
          handleAt(there, frame.view, cursorIn(frame), kReach * studio.theme.scale / frame.size.y);
      if (handle >= 0) {
        gizmo.held = there;
        gizmo.handle = handle;
        gizmo.from = cursorIn(frame);
        gizmo.placed = thing->placed;
      }
    }
  }
  if (!gizmo.held) return false;
  const auto by = draggedBy(*gizmo.held, gizmo.handle, frame.view, gizmo.from, cursorIn(frame));
  const auto thing = by ? selectedThing(studio) : std::nullopt;
  if (!thing) return true;
  constexpr int kDigits = 9;
  const Affine dragged = withoutNoise(*by * gizmo.placed);
  const GizmoMode mode = gizmo.held->mode;
  place(studio, mode == GizmoMode::move    ? dragged
                : mode == GizmoMode::scale ? standing(studio, gizmo.placed, dragged)
                                           : rayfile::inShortNumbers(dragged, kDigits));
  return true;
}

bool drawGizmo(Studio& studio, const SpaceFrame& frame) {
  const GizmoHold& hold = studio.rays.gizmo;
  const auto thing = selectedThing(studio);
  if (!thing) return false;
  const Gizmo gizmo = gizmoOf(studio, *thing, frame.view);
  const bool over = ImGui::IsItemHovered() && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2);
  const int under =
      hold.held ? hold.handle
      : over    ? handleAt(gizmo, frame.view, cursorIn(frame), kReach * studio.theme.scale / frame.size.y)
                : -1;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(frame.low, {frame.low.x + frame.size.x, frame.low.y + frame.size.y}, true);
  constexpr ImU32 kColours[] = {IM_COL32(235, 80, 80, 255), IM_COL32(90, 200, 90, 255),
                                IM_COL32(90, 140, 255, 255), IM_COL32(230, 230, 230, 255)};
  constexpr ImU32 kUnder = IM_COL32(255, 210, 60, 255);
  for (int handle = 0; handle < Gizmo::kHandles; ++handle) {
    const ImU32 colour = handle == under ? kUnder : kColours[handle];
    std::optional<ImVec2> last;
    for (const Vec3& point : handleLine(gizmo, handle)) {
      const auto at = frame.view.placeOf(point);
      std::optional<ImVec2> here;
      if (at)
        here = ImVec2{frame.low.x + static_cast<float>(at->x) * frame.size.x,
                      frame.low.y + (1 - static_cast<float>(at->y)) * frame.size.y};
      if (last && here) list.AddLine(*last, *here, colour, 2.5f * studio.theme.scale);
      last = here;
    }
    const float tip = 4.5f * studio.theme.scale;
    if (!last || handle == Gizmo::kWhole || gizmo.mode == GizmoMode::turn) continue;
    if (gizmo.mode == GizmoMode::move)
      list.AddCircleFilled(*last, tip, colour);
    else
      list.AddRectFilled({last->x - tip, last->y - tip}, {last->x + tip, last->y + tip}, colour);
  }
  list.PopClipRect();
  return under >= 0;
}

}  // namespace trace::studio
