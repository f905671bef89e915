// The panel Scene: a tree of what there is, and below it the fields of what is selected. Editors, entries of
// the menus and names come from the lists of shapes, lights and materials.
#include <imgui.h>

#include <cstdio>
#include <filesystem>

#include "base/match.h"
#include "studio/field_editor.h"
#include "studio/panels.h"

namespace trace::studio {
namespace {

using Selected = Studio::Selected;

std::string nameOf(const std::string& name, std::string_view keyword, const Place& place) {
  if (!name.empty()) return name;
  std::string text(keyword);
  if (place.line > 0) text += ", line " + std::to_string(place.line);
  return text;
}
std::string nameOf(const Object& object) {
  return nameOf(object.name, match(object.shape, [](const auto& s) { return s.kKeyword; }), object.place);
}
std::string nameOf(const LightSource& source) {
  return nameOf("", match(source.light, [](const auto& l) { return l.kKeyword; }), source.place);
}
std::string nameOf(const Material& material, std::size_t index) {
  return material.name.empty() ? "material " + std::to_string(index + 1) : material.name;
}

Material newMaterial() {
  Phong grey;
  grey.diffuse = Color(0.7);
  return {"", grey, {}};
}

/// An edit of the document in the making: a copy of the scene, handed over when something has changed.
class Edit {
 public:
  explicit Edit(Studio& studio) : scene(studio.workspace.document.scene()), studio_(studio) {}
  Scene scene;

  /// One step for each time a widget is held; GetID() tells the widgets apart.
  void changed(const std::string& what) {
    const unsigned id = ImGui::GetID("edit");
    const bool continues = studio_.editedItem == id;
    studio_.editedItem = id;
    studio_.workspace.document.edit(what, scene, continues);
  }
  void done(const std::string& what) { studio_.workspace.document.edit(what, scene); }

 private:
  Studio& studio_;
};

// --- the tree -----------------------------------------------------------------------------------------

void entry(Studio& studio, Selected kind, std::size_t index, const std::string& name) {
  ImGui::PushID(static_cast<int>(index));
  const bool selected = studio.selected == kind && studio.selectedIndex == index;
  if (ImGui::Selectable(name.c_str(), selected)) studio.selected = kind, studio.selectedIndex = index;
  ImGui::PopID();
}

template <class NameOf>
void branch(Studio& studio, Selected kind, const char* title, std::size_t count, NameOf&& name) {
  char label[64];
  std::snprintf(label, sizeof label, "%s (%zu)###%s", title, count, title);
  const ImGuiTreeNodeFlags open = count <= 40 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
  if (!ImGui::TreeNodeEx(label, ImGuiTreeNodeFlags_SpanAvailWidth | open)) return;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(count));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      entry(studio, kind, static_cast<std::size_t>(i), name(static_cast<std::size_t>(i)));
  ImGui::TreePop();
}

void addMenu(Studio& studio) {
  if (ImGui::Button("Add...")) ImGui::OpenPopup("add");
  if (!ImGui::BeginPopup("add")) return;
  Edit edit(studio);
  ImGui::TextDisabled("Objects");
  forEachType<Shape>([&]<class T>(T*) {
    if constexpr (!std::is_same_v<T, Mesh>) {
      if (ImGui::MenuItem(std::string(T::kKeyword).c_str())) {
        if (edit.scene.materials.empty()) edit.scene.materials.push_back(newMaterial());
        edit.scene.objects.push_back({"", T{}, {}, 0, {}});
        studio.selected = Selected::object, studio.selectedIndex = edit.scene.objects.size() - 1;
        edit.done("add " + std::string(T::kKeyword));
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(T::kHelp).c_str());
    }
  });
  ImGui::Separator();
  ImGui::TextDisabled("Lights");
  forEachType<Light>([&]<class T>(T*) {
    if (ImGui::MenuItem(std::string(T::kKeyword).c_str())) {
      T light;
      light.color = Color(1);
      if constexpr (requires { light.position; }) light.position = edit.scene.camera.position;
      edit.scene.lights.push_back({light, {}});
      studio.selected = Selected::light, studio.selectedIndex = edit.scene.lights.size() - 1;
      edit.done("add " + std::string(T::kKeyword));
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(T::kHelp).c_str());
  });
  ImGui::Separator();
  if (ImGui::MenuItem("material")) {
    edit.scene.materials.push_back(newMaterial());
    studio.selected = Selected::material, studio.selectedIndex = edit.scene.materials.size() - 1;
    edit.done("add material");
  }
  ImGui::EndPopup();
}

// --- what is selected ---------------------------------------------------------------------------------

void heading(Studio& studio, const std::string& name, std::string_view help, const Place& place) {
  ImGui::TextColored(studio.palette().accent, "%s", name.c_str());
  if (place.line > 0) {
    ImGui::SameLine();
    ImGui::TextDisabled("%s:%d", std::filesystem::path(place.file).filename().string().c_str(), place.line);
  }
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", std::string(help).c_str());
  ImGui::PopTextWrapPos();
}

bool dragThree(const char* name, const char* help, double (&values)[3], float speed, const char* format) {
  fieldName(name, help);
  ImGui::SetNextItemWidth(-1);
  return ImGui::DragScalarN(("##" + std::string(name)).c_str(), ImGuiDataType_Double, values, 3, speed,
                            nullptr, nullptr, format);
}

/// Moves, turns and scales; each drag multiplies what is there. The twelve numbers are below.
void editTransform(Edit& edit, Object& object) {
  Affine& m = object.worldFromObject;
  const Vec3 at = m.offset;
  double place[3] = {at.x, at.y, at.z};
  ImGui::PushID("move");
  const double size = std::max({length(m.row[0]), length(m.row[1]), length(m.row[2]), 1e-9});
  if (dragThree("move", "where the object's origin lies in the world", place, static_cast<float>(size / 50),
                "%.4g")) {
    m.offset = {place[0], place[1], place[2]};
    edit.changed("move " + nameOf(object));
  }
  ImGui::PopID();

  ImGui::PushID("turn");
  double angle[3] = {};
  if (dragThree("turn", "drag to turn about the world's axes, through the object's origin; degrees", angle,
                0.5f, "%.3g")) {
    m.offset = {};
    const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; ++i)
      if (angle[i] != 0) m = Affine::rotation(axes[i], angle[i] * kPi / 180) * m;
    m.offset = at;
    edit.changed("turn " + nameOf(object));
  }
  ImGui::PopID();

  ImGui::PushID("scale");
  double factor[3] = {1, 1, 1};
  if (dragThree("scale", "drag to stretch along the object's own axes", factor, 0.005f, "x %.3g")) {
    const auto sane = [](double f) { return std::isfinite(f) ? std::clamp(f, 0.01, 100.0) : 1; };
    m = m * Affine::scaling({sane(factor[0]), sane(factor[1]), sane(factor[2])});
    edit.changed("scale " + nameOf(object));
  }
  ImGui::PopID();

  for (int i = 0; i < 3; ++i) {
    ImGui::PushID(i);
    double row[3] = {m.row[i].x, m.row[i].y, m.row[i].z};
    const char* names[] = {"matrix x", "matrix y", "matrix z"};
    if (dragThree(names[i], "row of the 3 x 3 part of the transform from object to world", row, 0.01f,
                  "%.4g")) {
      m.row[i] = {row[0], row[1], row[2]};
      edit.changed("transform " + nameOf(object));
    }
    ImGui::PopID();
  }
}

/// True if the thing is to go.
bool deleteButton() {
  ImGui::SameLine();
  return ImGui::Button("Delete");
}

void editObject(Studio& studio) {
  Edit edit(studio);
  auto& objects = edit.scene.objects;
  Object& object = objects[studio.selectedIndex];
  match(object.shape, [&](const auto& shape) { heading(studio, nameOf(object), shape.kHelp, object.place); });
  if (const auto* mesh = std::get_if<Mesh>(&object.shape))
    ImGui::Text("%zu triangles, %zu points", mesh->data->triangles.size(), mesh->data->points.size());
  if (ImGui::Button("Duplicate")) {
    Object copy = object;
    copy.place = {};
    objects.push_back(std::move(copy));
    studio.selectedIndex = objects.size() - 1;
    return edit.done("duplicate");
  }
  if (deleteButton()) {
    const std::string what = "delete " + nameOf(object);
    objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(studio.selectedIndex));
    return edit.done(what);
  }
  if (!beginFields("object")) return;
  fieldName("name", "what messages and the panels call it");
  if (editValue({}, object.name)) edit.changed("name");
  fieldName("material", "click on the name to go there");
  const auto materialName = [&](std::size_t i) { return nameOf(edit.scene.materials[i], i); };
  const float jump = ImGui::CalcTextSize("edit").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(-jump - ImGui::GetStyle().ItemSpacing.x);
  if (ImGui::BeginCombo("##material", materialName(object.material).c_str())) {
    for (std::size_t i = 0; i < edit.scene.materials.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(materialName(i).c_str(), i == object.material)) {
        object.material = static_cast<std::uint32_t>(i);
        edit.done("material of " + nameOf(object));
      }
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  if (ImGui::Button("edit")) studio.selected = Selected::material, studio.selectedIndex = object.material;
  match(object.shape, [&](auto& shape) {
    editFields(shape, [&](std::string_view key) { edit.changed(nameOf(object) + ": " + std::string(key)); });
  });
  editTransform(edit, object);
  endFields();
}

void editLight(Studio& studio) {
  Edit edit(studio);
  LightSource& source = edit.scene.lights[studio.selectedIndex];
  match(source.light, [&](const auto& light) { heading(studio, nameOf(source), light.kHelp, source.place); });
  ImGui::NewLine();
  if (deleteButton()) {
    edit.scene.lights.erase(edit.scene.lights.begin() + static_cast<std::ptrdiff_t>(studio.selectedIndex));
    return edit.done("delete light");
  }
  if (!beginFields("light")) return;
  match(source.light, [&](auto& light) {
    editFields(light, [&](std::string_view key) { edit.changed(nameOf(source) + ": " + std::string(key)); });
  });
  endFields();
}

/// What else follows when a field was set by hand.
void fieldWasSet(Phong& phong, std::string_view keyword) {
  if (keyword == "reflective") phong.mirrorsSpecular = false;
}
[[maybe_unused]] void fieldWasSet(auto&, std::string_view) {}

void editMaterial(Studio& studio) {
  Edit edit(studio);
  Material& material = edit.scene.materials[studio.selectedIndex];
  const std::string name = nameOf(material, studio.selectedIndex);
  match(material.model, [&](const auto& model) { heading(studio, name, model.kHelp, {}); });
  std::size_t users = 0;
  for (const Object& object : edit.scene.objects) users += object.material == studio.selectedIndex;
  ImGui::TextDisabled("used by %zu %s", users, users == 1 ? "object" : "objects");
  if (!beginFields("material")) return;
  fieldName("name", "what the panels call it");
  if (editValue({}, material.name)) edit.changed("name");
  match(material.model, [&](auto& model) {
    editFields(model, [&](std::string_view key) {
      fieldWasSet(model, key);
      edit.changed(name + ": " + std::string(key));
    });
  });
  endFields();
  for (const FieldMap& map : material.maps)
    ImGui::TextDisabled("%s is a map: %s", map.field.c_str(), map.file.c_str());
}

void editCamera(Studio& studio) {
  Edit edit(studio);
  heading(studio, "camera", Camera::kHelp, {});
  if (!beginFields("camera")) return;
  editFields(edit.scene.camera, [&](std::string_view key) { edit.changed("camera: " + std::string(key)); });
  endFields();
}

}  // namespace

void drawScene(Studio& studio) {
  Document& document = studio.workspace.document;
  if (!document.isOpen()) return ImGui::TextDisabled("no scene is open");
  addMenu(studio);
  const auto step = [](const char* name, const std::string& what, auto&& run) {
    ImGui::SameLine();
    ImGui::BeginDisabled(what.empty());
    if (ImGui::Button(name)) run();
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", what.c_str());
  };
  step("Undo", document.undoName(), [&] { document.undo(); });
  step("Redo", document.redoName(), [&] { document.redo(); });

  const Scene& scene = document.scene();
  ImGui::BeginChild("tree", {0, ImGui::GetContentRegionAvail().y * 0.42f}, true);
  entry(studio, Selected::camera, 0, "camera");
  branch(studio, Selected::light, "lights", scene.lights.size(),
         [&](std::size_t i) { return nameOf(scene.lights[i]); });
  branch(studio, Selected::object, "objects", scene.objects.size(),
         [&](std::size_t i) { return nameOf(scene.objects[i]); });
  branch(studio, Selected::material, "materials", scene.materials.size(),
         [&](std::size_t i) { return nameOf(scene.materials[i], i); });
  ImGui::EndChild();

  // Undo and deleting may leave the selection beyond the end.
  const std::size_t count = studio.selected == Selected::object     ? scene.objects.size()
                            : studio.selected == Selected::light    ? scene.lights.size()
                            : studio.selected == Selected::material ? scene.materials.size()
                                                                    : 1;
  if (studio.selectedIndex >= count) studio.selected = Selected::camera, studio.selectedIndex = 0;
  ImGui::BeginChild("fields");
  ImGui::PushID(static_cast<int>(studio.selectedIndex));
  switch (studio.selected) {
    case Selected::camera: editCamera(studio); break;
    case Selected::object: editObject(studio); break;
    case Selected::light: editLight(studio); break;
    case Selected::material: editMaterial(studio); break;
  }
  ImGui::PopID();
  ImGui::EndChild();
}

}  // namespace trace::studio
