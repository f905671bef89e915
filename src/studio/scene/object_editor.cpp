#include "studio/scene/object_editor.h"

#include <imgui.h>

#include "app/editing/placing.h"
#include "base/text.h"
#include "geometry/field_value.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "studio/scene/selection.h"
#include "studio/studio.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/number_field.h"

namespace trace::studio {
namespace {

using Changed = std::function<void(const std::string& what)>;

constexpr double kAny = 1e300;

bool editThree(const char* name, const char* help, Vec3& value, NumberLook look) {
  const std::string said = saidName(name);
  look.name = said;
  fieldName(name, help);
  double values[3] = {value.x, value.y, value.z};
  ImGui::PushID(name);
  const bool changed = editNumbersInRow(values, 3, look);
  ImGui::PopID();
  if (changed) value = {values[0], values[1], values[2]};
  return changed;
}

/// Moves, turns and scales; what is dragged or typed multiplies what is there. The twelve numbers are below.
/// What would make the object flat goes back.
void editTransform(Studio& studio, Affine& m, const std::string& name, const Changed& keep) {
  const Affine before = m;
  const auto changed = [&](const std::string& what) {
    if (keepsObject(m)) return keep(what);
    m = before;
    studio.refuse(what + " was not taken: its matrix would make the object flat, or not finite");
  };
  const double size = std::max({length(m.row[0]), length(m.row[1]), length(m.row[2]), 1e-9});
  if (editThree("move", "position of the object's origin in its parent", m.offset,
                {-kAny, kAny, "%.4g", static_cast<float>(size / 50)}))
    changed("move " + name);
  Vec3 degrees;
  if (editThree("turn",
                "drag, or type degrees, to turn about the axes x, y, z through the object's origin; then it "
                "shows 0 again",
                degrees, {-kAny, kAny, "%.3g", 0.5f})) {
    m = turned(m, degrees);
    changed("turn " + name);
  }
  Vec3 factors(1, 1, 1);
  const NumberLook factor{.least = 0.01, .most = 100, .format = "x %.3g", .speed = 0.005f, .clamped = false};
  if (editThree("scale",
                "drag, or type a factor, to stretch along the object's own axes; then it shows 1 again",
                factors, factor)) {
    for (int i = 0; i < 3; ++i)
      if (!isFactor(factors[i]))
        return studio.refuse("scale " + name +
                             " was not taken: expected a factor from 1e-6 to 1e6, or below 0, found " +
                             toText(factors[i]));
    m = stretched(m, factors);
    changed("scale " + name);
  }
  const char* const kRows[] = {"matrix x", "matrix y", "matrix z"};
  for (int i = 0; i < 3; ++i)
    if (editThree(kRows[i], "row of the 3 x 3 part of the transform out of the object's space", m.row[i],
                  {-kAny, kAny, "%.4g", 0.01f}))
      changed("transform " + name);
}

void editMaterialOf(Studio& studio, const std::string& name, std::uint32_t& material,
                    const Changed& changed) {
  const std::vector<Material>& materials = studio.workspace.document.scene().materials;
  fieldName("material", "of the scene's materials; the button goes there");
  const float jump = ImGui::CalcTextSize("edit").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(-jump - ImGui::GetStyle().ItemSpacing.x);
  if (ImGui::BeginCombo("##material", nameOf(materials[material], material).c_str())) {
    for (std::size_t i = 0; i < materials.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(nameOf(materials[i], i).c_str(), i == material)) {
        material = static_cast<std::uint32_t>(i);
        changed("material of " + name);
      }
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  if (ImGui::Button("edit")) studio.select(Studio::Selected::material, material);
}

/// The objects of a solid of solids, each folded up.
void editOperands(Studio& studio, Shape& whole, std::uint32_t material, const Changed& changed) {
  const Operands shown = whole.operands();
  const std::vector<Operand>& now = shown.list();
  const auto become = [&](std::vector<Operand> list, const std::string& what) {
    whole.setOperands(Operands(std::move(list)));
    changed(what);
  };
  for (std::size_t i = 0; i < now.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const std::string name = nameOf(now[i].name, now[i].shape);
    const ImGuiID node = ImGui::GetID("operand");
    const bool open =
        ImGui::TreeNodeEx("operand", ImGuiTreeNodeFlags_SpanAvailWidth, "%zu: %s", i + 1, name.c_str());
    bool gone = false;
    if (open) {
      if (buttonOnce("Delete", true)) {
        ImGui::GetStateStorage()->SetInt(node, 0);  // the next one comes here, folded up
        std::vector<Operand> list = now;
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
        become(std::move(list), "delete " + name);
        gone = true;
      }
      ImGui::SameLine();
      ImGui::BeginDisabled(i == 0);
      if (!gone && buttonOnce("Up", true)) {
        std::vector<Operand> list = now;
        std::swap(list[i], list[i - 1]);
        become(std::move(list), "order of " + name);
        gone = true;
      }
      ImGui::EndDisabled();
      if (!gone) {
        Operand operand = now[i];
        editPlacedShape(studio, {operand.name, operand.shape, operand.wholeFromOperand, operand.material},
                        [&](const std::string& what) {
                          gone = true;
                          std::vector<Operand> list = whole.operands().list();
                          list[i] = operand;
                          become(std::move(list), what);
                        });
      }
      ImGui::TreePop();
    }
    ImGui::PopID();
    if (gone) return;  // the list is another now
  }
  if (ImGui::SmallButton("Add to it...")) ImGui::OpenPopup("add operand");
  if (!ImGui::BeginPopup("add operand")) return;
  shapeMenu([&](Shape shape) {
    std::vector<Operand> list = whole.operands().list();
    const std::string name = nameOf("", shape);
    list.push_back({"", std::move(shape), {}, material});
    become(std::move(list), "add " + name);
  });
  ImGui::EndPopup();
}

}  // namespace

std::string nameOf(const std::string& name, const Shape& shape) {
  return name.empty() ? std::string(shape.keyword()) : name;
}

void editPlacedShape(Studio& studio, PlacedShape placed, const Changed& changed) {
  const std::string name = nameOf(placed.name, placed.shape);
  const FieldsWithin within(name + ":");
  if (beginFields("placed")) {
    fieldName("name", "its name in messages and panels");
    if (editValue({}, placed.name)) changed("name");
    editMaterialOf(studio, name, placed.material, changed);
    editFields(placed.shape, [&](std::string_view key) { changed(name + ": " + std::string(key)); });
    endFields();
  }
  if (placed.shape.type().ofObjects) {
    for (const AnyField& field : placed.shape.fields())
      if (std::holds_alternative<Operands*>(field.value))
        ImGui::TextDisabled("%s", std::string(field.help).c_str());
    editOperands(studio, placed.shape, placed.material, changed);
  }
  if (!beginFields("place")) return;
  editTransform(studio, placed.transform, name, changed);
  endFields();
}

void shapeMenu(const std::function<void(Shape)>& chosen) {
  for (const ShapeType& type : shapeTypes()) {
    if (type.keyword == Mesh::kKeyword) continue;
    if (ImGui::MenuItem(std::string(type.keyword).c_str())) chosen(Shape(type));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(type.help).c_str());
  }
}

}  // namespace trace::studio
