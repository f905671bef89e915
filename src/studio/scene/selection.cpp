#include "studio/scene/selection.h"

#include <imgui.h>

#include "app/editing/placing.h"
#include "app/editing/scene_changes.h"
#include "scene/picture_size.h"
#include "studio/scene/object_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

using Selected = Studio::Selected;

std::string withLine(const std::string& name, const SourcePlace& place) {
  return place.line > 0 ? name + ", line " + std::to_string(place.line) : name;
}

template <class Thing>
bool holds(const std::vector<Thing>& list, const Studio& studio) {
  return studio.selectedIndex < list.size();
}

template <class Thing>
void followList(Studio& studio, Selected kind, const std::vector<Thing>& before,
                const std::vector<Thing>& after) {
  if (const auto came = oneMore(before, after)) return studio.select(kind, *came);
  const auto gone = oneMore(after, before);
  if (!gone || studio.selected != kind || studio.selectedIndex < *gone) return;
  if (studio.selectedIndex == *gone) {
    studio.selected = Selected::none;
    studio.selectedIndex = 0;
  } else
    --studio.selectedIndex;
}

void go(Studio& studio, void (Workspace::*way)()) {
  if (!studio.workspace.document.isOpen()) return;
  const std::shared_ptr<const Scene> before = studio.workspace.document.sharedScene();
  (studio.workspace.*way)();
  const std::shared_ptr<const Scene> after = studio.workspace.document.sharedScene();
  if (before == after) return;
  followList(studio, Selected::object, before->objects, after->objects);
  followList(studio, Selected::light, before->lights, after->lights);
}

}  // namespace

std::size_t howMany(const Scene& scene, Selected kind) {
  switch (kind) {
    case Selected::object: return scene.objects.size();
    case Selected::light: return scene.lights.size();
    case Selected::material: return scene.materials.size();
    default: return 1;
  }
}

void undo(Studio& studio) { go(studio, &Workspace::undo); }
void redo(Studio& studio) { go(studio, &Workspace::redo); }

std::string entryName(const Object& object) {
  return object.name.empty() ? withLine(nameOf("", object.shape), object.place) : object.name;
}

std::string entryName(const LightSource& source) {
  if (!source.links.name.empty()) return source.links.name;
  return withLine(std::string(source.light.keyword()), source.place);
}

bool canDuplicate(const Studio& studio) {
  const Document& document = studio.workspace.document;
  return document.isOpen() && studio.selected == Selected::object && holds(document.scene().objects, studio);
}

bool canDelete(const Studio& studio) {
  const Document& document = studio.workspace.document;
  const bool light =
      document.isOpen() && studio.selected == Selected::light && holds(document.scene().lights, studio);
  return light || canDuplicate(studio);
}

void deleteSelected(Studio& studio) {
  Document& document = studio.workspace.document;
  Scene scene = document.scene();
  const auto at = static_cast<std::ptrdiff_t>(studio.selectedIndex);
  std::string name;
  if (studio.selected == Selected::object) {
    name = entryName(scene.objects[studio.selectedIndex]);
    scene.objects.erase(scene.objects.begin() + at);
  } else {
    name = entryName(scene.lights[studio.selectedIndex]);
    scene.lights.erase(scene.lights.begin() + at);
  }
  document.edit("delete " + name, std::move(scene));
  studio.selected = Selected::none;
  studio.selectedIndex = 0;
}

void duplicateSelected(Studio& studio) {
  Document& document = studio.workspace.document;
  Scene scene = document.scene();
  Object copy = scene.objects[studio.selectedIndex];
  copy.place = {};
  const Box3 box = boxOf(copy);
  if (!box.empty() && !box.unbounded()) {  // beside the others, so that it is seen
    const CameraFrame camera = frame(cameraFor(scene, document.settings()), document.settings().cameraAxes);
    const Vec3 by = freedFrom(boxesOf(scene), box, camera, scene.camera.updir);
    copy.worldFromObject = withoutNoise(Affine::translation(by) * copy.worldFromObject);
  }
  scene.objects.push_back(std::move(copy));
  studio.select(Selected::object, scene.objects.size() - 1);
  studio.workspace.edit("duplicate", std::move(scene));
}

bool buttonOnce(const char* label, bool small) {
  const bool pressed = small ? ImGui::SmallButton(label) : ImGui::Button(label);
  landmark(std::string("button ") + label);
  const bool again = ImGui::IsMouseReleased(0) && ImGui::GetIO().MouseClickedLastCount[0] > 1;
  return pressed && !again;
}

}  // namespace trace::studio
