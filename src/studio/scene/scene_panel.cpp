// The panel Scene: a tree of what there is, and below it the fields of what is selected. Editors, entries of
// the menus and names come from the lists of shapes, lights and materials.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/editing/camera_words.h"
#include "app/editing/edits.h"
#include "app/editing/placing.h"
#include "app/editing/scene_changes.h"
#include "app/editing/typed_file.h"
#include "base/files/file.h"
#include "base/text.h"
#include "geometry/mesh/mesh.h"
#include "studio/panels.h"
#include "studio/scene/additions_popup.h"
#include "studio/scene/object_editor.h"
#include "studio/scene/selection.h"
#include "studio/widgets/drag.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/texture_editor.h"

namespace trace::studio {
namespace {

using Selected = Studio::Selected;

/// One step, however long the widget is held; GetID() tells widgets apart. apply(Scene&) makes the change.
template <class Apply>
void change(Studio& studio, const std::string& what, Apply&& apply) {
  const unsigned id = ImGui::GetID("edit");
  const bool continues = studio.editedItem == id;
  studio.editedItem = id;
  Scene scene = studio.workspace.document.scene();
  apply(scene);
  const std::size_t told = studio.workspace.log().size();
  studio.workspace.edit(what, std::move(scene), continues);
  if (studio.workspace.log().size() > told) studio.mention("Log");
}

/// The whole of the last row of the list.
void scrollIntoView() {
  const float top = ImGui::GetWindowPos().y + ImGui::GetWindowContentRegionMin().y + ImGui::GetScrollY();
  const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowContentRegionMax().y + ImGui::GetScrollY();
  if (ImGui::GetItemRectMin().y < top || ImGui::GetItemRectMax().y > bottom) ImGui::SetScrollHereY();
}

// --- the tree -----------------------------------------------------------------------------------------

void entry(Studio& studio, Selected kind, std::size_t index, const std::string& name) {
  ImGui::PushID(static_cast<int>(index));
  const bool selected = studio.selected == kind && studio.selectedIndex == index;
  if (ImGui::Selectable(name.c_str(), selected)) {
    studio.selected = kind;
    studio.selectedIndex = index;
  }
  landmark("entry " + std::string(Studio::kSelectedNames[static_cast<int>(kind)]) + " " +
           std::to_string(index));
  if (selected && studio.revealSelected) scrollIntoView();
  ImGui::PopID();
}

template <class NameOf>
void branch(Studio& studio, Selected kind, const char* title, std::size_t count, NameOf&& name) {
  char label[64];
  std::snprintf(label, sizeof label, "%s (%zu)###%s", title, count, title);
  const ImGuiTreeNodeFlags open = count <= 40 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
  const bool reveals = studio.revealSelected && studio.selected == kind && studio.selectedIndex < count;
  if (reveals) ImGui::SetNextItemOpen(true);
  if (!ImGui::TreeNodeEx(label, ImGuiTreeNodeFlags_SpanAvailWidth | open)) return;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(count));
  const int revealed = static_cast<int>(studio.selectedIndex);
  if (reveals) clipper.ForceDisplayRangeByIndices(revealed, revealed + 1);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      entry(studio, kind, static_cast<std::size_t>(i), name(static_cast<std::size_t>(i)));
  ImGui::TreePop();
}

// --- what is selected ---------------------------------------------------------------------------------

void heading(Studio& studio, const std::string& name, std::string_view help, const SourcePlace& place) {
  ImGui::TextColored(studio.palette().accent, "%s", name.c_str());
  if (place.line > 0) {
    ImGui::SameLine();
    ImGui::TextDisabled("%s:%d", std::filesystem::path(place.file.str()).filename().generic_string().c_str(),
                        place.line);
  }
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", std::string(help).c_str());
  ImGui::PopTextWrapPos();
}

/// Links between lights and objects: lists of names, chosen from those of the others that have one.
template <class Links, class Others, class NameOf, class Changed>
void editLinks(Links& links, const Others& others, const NameOf& nameOf, const Changed& changed) {
  std::vector<std::string> names;
  for (const auto& other : others)
    if (const std::string& name = nameOf(other);
        !name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  forEachField<Links>([&](const auto& field) {
    auto& value = links.*field.member;
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::vector<std::string>>) {
      fieldName(field.keyword, field.help);
      ImGui::PushID(field.keyword.data());
      const bool all = std::string_view(field.help).ends_with("none: all");
      if (editNames(names, value, all ? "all" : "none")) changed(field.keyword);
      ImGui::PopID();
    } else {
      editField(field, value, changed);
    }
  });
}

void editObject(Studio& studio) {
  const std::size_t index = studio.selectedIndex;
  Object object = studio.workspace.document.scene().objects[index];
  heading(studio, entryName(object), object.shape.type().help, object.place);
  if (const auto* mesh = object.shape.as<Mesh>())
    ImGui::TextUnformatted((counted(mesh->data->triangles.size(), "triangle") + ", " +
                            counted(mesh->data->points.size(), "point"))
                               .c_str());
  if (buttonOnce("Duplicate")) return duplicateSelected(studio);
  ImGui::SameLine();
  if (buttonOnce("Delete")) return deleteSelected(studio);
  editPlacedShape(studio, {object.name, object.shape, object.worldFromObject, object.material},
                  [&](const std::string& what) {
                    change(studio, what, [&](Scene& scene) { scene.objects[index] = object; });
                  });
  if (!beginFields("links")) return;
  editLinks(
      object.links, studio.workspace.document.scene().lights,
      [](const LightSource& light) -> const std::string& { return light.links.name; },
      [&](std::string_view key) {
        change(studio, entryName(object) + ": " + std::string(key),
               [&](Scene& scene) { scene.objects[index] = object; });
      });
  endFields();
}

void editLight(Studio& studio) {
  const std::size_t index = studio.selectedIndex;
  LightSource source = studio.workspace.document.scene().lights[index];
  heading(studio, entryName(source), source.light.type().help, source.place);
  if (buttonOnce("Delete")) return deleteSelected(studio);
  if (!beginFields("light")) return;
  const FieldsWithin within(entryName(source) + ":");
  const auto changed = [&](std::string_view key) {
    change(studio, entryName(source) + ": " + std::string(key),
           [&](Scene& scene) { scene.lights[index] = source; });
  };
  editFields(source.light, changed);
  editLinks(
      source.links, studio.workspace.document.scene().objects,
      [](const Object& object) -> const std::string& { return object.name; }, changed);
  endFields();
}

void editMaterial(Studio& studio) {
  const std::size_t index = studio.selectedIndex;
  const Scene& scene = studio.workspace.document.scene();
  Material material = scene.materials[index];
  const std::string name = nameOf(material, index);
  heading(studio, name, material.model.type().help, {});
  const std::size_t users = usersOf(scene, static_cast<std::uint32_t>(index));
  ImGui::TextDisabled("used by %zu %s", users, users == 1 ? "object" : "objects");
  landmark("used by " + std::to_string(users));
  const auto changed = [&](const std::string& what) {
    change(studio, what, [&](Scene& next) { next.materials[index] = material; });
  };
  if (!beginFields("material", true)) return;
  const FieldsWithin within(name + ":");
  fieldName("name", "its name in the panels");
  if (editValue({}, material.name)) changed("name");
  const std::vector<std::string_view> models = modelKeywords();
  std::size_t chosen = material.model.type().index;
  fieldName("model", "how the surface scatters light; fields that both models have keep their values");
  ImGui::PushID("model");
  const bool otherModel = editChoice(models.data(), models.size(), chosen);
  ImGui::PopID();
  if (otherModel) {
    material = withModel(std::move(material), MaterialModel(modelTypes()[chosen]));
    changed(name + ": model " + std::string(models[chosen]));
  }
  std::vector<FieldTexture>& textures = material.textures;
  const MaterialModel before = material.model;
  editEachField(material.model, [&](const ModelField& f, auto& value) {
    editTexturedField(f, value, textures, [&](const std::string& what) {
      if (Phong* phong = material.model.edit<Phong>()) followEdit(*phong, *before.as<Phong>(), f.keyword);
      changed(name + ": " + what);
    });
  });
  forEachField<Material>([&](const auto& f) {
    editTexturedField(f, material.*f.member, textures,
                      [&](const std::string& what) { changed(name + ": " + what); });
  });
  endFields();
}

/// The editor of a thing that a scene has once.
template <class Thing>
void editOnly(Studio& studio, Thing Scene::*member) {
  const Thing before = studio.workspace.document.scene().*member;
  const std::string name(Thing::kKeyword);
  if constexpr (std::is_same_v<Thing, Camera>)
    heading(studio, name, cameraSentence(studio.workspace.document.settings()), {});
  else
    heading(studio, name, Thing::kHelp, {});
  if (!beginFields(name.c_str())) return;
  const FieldsWithin within(name + ":");
  Thing thing = before;
  editFields(thing, [&](std::string_view key) {
    followEdit(thing, before, key);
    if constexpr (std::is_same_v<Thing, Camera>) {
      const std::optional<Vec3> lookAt = studio.workspace.document.lookAt();
      followMove(thing, key, lookAt);
      if (!cameraSees(thing)) {
        thing = before;
        return studio.refuse("camera: " + std::string(key) + " was not taken: the camera would see nothing");
      }
      if (lookAt && key == "viewdir")
        studio.refuse("camera: viewdir replaces the file's look_at from now on");
    }
    change(studio, name + ": " + std::string(key), [&](Scene& scene) { scene.*member = thing; });
  });
  endFields();
}

/// The bar below the list, which makes it larger and smaller.
void listBar(float& share, float whole) {
  const float high = std::max(4.0f, ImGui::GetStyle().ItemSpacing.y);
  ImGui::InvisibleButton("list bar", {-1, high});
  landmark("list bar");
  const bool active = ImGui::IsItemActive();
  if (active || ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  const ImVec2 at = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
  const ImU32 colour = ImGui::GetColorU32(active                   ? ImGuiCol_SeparatorActive
                                          : ImGui::IsItemHovered() ? ImGuiCol_SeparatorHovered
                                                                   : ImGuiCol_Separator);
  const float middle = std::round((at.y + end.y) / 2);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, middle - 1}, {end.x, middle + 1}, colour);
  if (active)
    share =
        std::clamp(share + dragged(ImGuiMouseButton_Left).y / whole, Layout::kLeastList, Layout::kMostList);
}

/// Names of files count from the scene's folder.
void chooseFieldsFile(Studio& studio, const FileWish& wish) {
  const std::string& scene = studio.workspace.document.file();
  studio.dialog.open(wish.title, FileDialog::Purpose::read,
                     wish.now.empty() ? scene : besideFile(scene, wish.now), wish.suffixes,
                     [&studio, field = wish.field](const std::string& file) {
                       giveFile(field, shownFile(file, studio.workspace.document.file()));
                     });
}

}  // namespace

void drawScene(Studio& studio) {
  const Document& document = studio.workspace.document;
  if (!document.isOpen()) return ImGui::TextDisabled("no scene is open");
  drawAdditions(studio);
  const auto step = [](const char* name, const std::string& what, auto&& run) {
    ImGui::SameLine();
    ImGui::BeginDisabled(what.empty());
    if (ImGui::Button(name)) run();
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", what.c_str());
  };
  step("Undo", studio.workspace.undoName(), [&] { undo(studio); });
  step("Redo", document.redoName(), [&] { redo(studio); });

  const Scene& scene = document.scene();
  const float whole = ImGui::GetContentRegionAvail().y;
  ImGui::BeginChild("tree", {0, std::round(whole * studio.layout.list)}, true, ImGuiWindowFlags_NavFlattened);
  entry(studio, Selected::camera, 0, "camera");
  entry(studio, Selected::background, 0, "background");
  branch(studio, Selected::light, "lights", scene.lights.size(),
         [&](std::size_t i) { return entryName(scene.lights[i]); });
  branch(studio, Selected::object, "objects", scene.objects.size(),
         [&](std::size_t i) { return entryName(scene.objects[i]); });
  branch(studio, Selected::material, "materials", scene.materials.size(),
         [&](std::size_t i) { return nameOf(scene.materials[i], i); });
  ImGui::EndChild();
  landmark("list");
  listBar(studio.layout.list, whole);
  studio.revealSelected = false;

  // Undo and deleting may leave the selection beyond the end.
  if (studio.selectedIndex >= howMany(scene, studio.selected)) {
    studio.selected = Selected::camera;
    studio.selectedIndex = 0;
  }
  ImGui::BeginChild("fields", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
  ImGui::PushID(static_cast<int>(studio.selectedIndex));
  switch (studio.selected) {
    case Selected::camera: editOnly(studio, &Scene::camera); break;
    case Selected::background: editOnly(studio, &Scene::background); break;
    case Selected::object: editObject(studio); break;
    case Selected::light: editLight(studio); break;
    case Selected::material: editMaterial(studio); break;
    case Selected::none: ImGui::TextDisabled("nothing is selected"); break;
  }
  ImGui::PopID();
  ImGui::EndChild();
  if (const std::optional<FileWish> wish = takeFileWish()) chooseFieldsFile(studio, *wish);
}

}  // namespace trace::studio
