// Widgets for the fields that the structs of a scene list (base/field.h): one for each type of value.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/field.h"
#include "base/find_field.h"
#include "base/text.h"
#include "geometry/field_value.h"
#include "geometry/shapes/surfaces/heights.h"
#include "math/color.h"
#include "math/vec.h"
#include "shading/formula_text.h"
#include "shading/lights/light.h"
#include "shading/pixels.h"

namespace trace::studio {

/// The description of the field for a widget.
struct FieldFacts {
  std::string_view unit;
  double least = -kNoLimit, most = kNoLimit;
  std::string_view name{};
  std::optional<double> unlimited{};  ///< its usual value, if that is infinite
};

// Each draws the widget and returns true when the value has changed.
bool editValue(const FieldFacts& facts, Real& value);
bool editValue(const FieldFacts& facts, int& value);
bool editValue(const FieldFacts& facts, bool& value);
bool editValue(const FieldFacts& facts, Vec3& value);
bool editValue(const FieldFacts& facts, Color& value);
/// A square of the colour, which opens a picker.
bool editSwatch(Color& value);
bool editValue(const FieldFacts& facts, std::string& value);
/// Shows the name of the picture: it is read with the scene.
bool editValue(const FieldFacts& facts, Heights& value);
/// A file is typed, or chosen in the dialog. It is read when the scene is edited so (Workspace::edit).
bool editValue(const FieldFacts& facts, Pixels& value);
bool editValue(const FieldFacts& facts, PhotometryFile& value);
bool editValue(const FieldFacts& facts, FormulaText& value);
/// Several numbers, in rows of at most four.
bool editNumbers(const FieldFacts& facts, double* values, std::size_t count);
/// Some of the names, in a list with boxes to tick; `none` is shown where none is chosen. One that is chosen
/// and not among them is shown too, and can be taken out.
bool editNames(const std::vector<std::string>& names, std::vector<std::string>& chosen, const char* none);
/// One of the names.
bool editChoice(const std::string_view* names, std::size_t count, std::size_t& value);

template <std::size_t N>
bool editValue(const FieldFacts& facts, std::array<Real, N>& value) {
  return editNumbers(facts, value.data(), N);
}
bool editValue(const FieldFacts& facts, EnumValue& value);
template <class Enum>
requires std::is_enum_v<Enum>
bool editValue(const FieldFacts& facts, Enum& value) {
  EnumValue any(value);
  return editValue(facts, any);
}
/// A list, folded up if it is long. Each element has a button that takes it out and one that repeats it.
template <class Element>
bool editValue(const FieldFacts& facts, std::vector<Element>& values);

/// A field that wants a file from the dialog.
struct FileWish {
  unsigned field;
  std::string title, now;
  std::vector<std::string> suffixes;
};
/// That of the last frame, once.
std::optional<FileWish> takeFileWish();
/// The field takes it when it is drawn next.
void giveFile(unsigned field, std::string name);

/// Begins a table of names and values, with a column for a button if it is so asked; false if it is not to be
/// seen.
bool beginFields(const char* id, bool buttons = false);
void endFields();
/// The text, or as much of it with ".." as is at most that wide.
std::string shortened(std::string_view text, float width);
/// The words in lines of at most that width: Dear ImGui would break a number at its point.
std::string inLines(std::string_view words, float most);
/// The name of a row, shortened by ".." where it does not fit.
void rowName(std::string_view name);
/// The tooltip that comes next stands beside the panel, so that it covers none of its rows.
void besidePanel();
/// The tooltip that comes next stands below the last item, or above it where there is no room.
void besideItem();
/// The name in the first column, with its help; the widget comes into the second.
void fieldName(std::string_view name, std::string_view help, const std::string& range = {});
std::string rangeText(const FieldFacts& facts);

/// While it lives, fields lie within what it names: `said` by remarks, as in "material 2:" or "diffuse
/// brick", and `field` by landmarks.
class FieldsWithin {
 public:
  explicit FieldsWithin(std::string_view said, std::string_view field = {});
  ~FieldsWithin();
  FieldsWithin(const FieldsWithin&) = delete;
  FieldsWithin& operator=(const FieldsWithin&) = delete;

 private:
  std::size_t said_, fields_;  ///< lengths before
};
/// The field as remarks name it: "material 2: diffuse brick a".
std::string saidName(std::string_view field);

/// One field, whose value is `usual` where a scene gives none; calls changed(keyword) after a change. Objects
/// are edited as objects; materials of a fractal stay as the file gave them.
template <class Field, class Value, class Changed>
void editField(const Field& field, Value& value, const Value& usual, Changed&& changed) {
  if constexpr (
      !requires { value.list(); } && !requires { value.indices; }) {
    FieldFacts facts{field.unit, field.least, field.most, field.keyword, {}};
    if constexpr (std::is_same_v<Value, Real>)
      if (std::isinf(usual)) facts.unlimited = usual;
    ImGui::PushID(field.keyword.data());
    fieldName(field.keyword, field.help, rangeText(facts));
    if (editValue(facts, value)) changed(field.keyword);
    ImGui::PopID();
  }
}

template <class Field, class Value, class Changed>
void editField(const Field& field, Value& value, Changed&& changed) {
  editField(field, value, value, changed);
}

/// All fields of the struct; calls changed(keyword) after a change. Between beginFields() and endFields().
template <class Struct, class Changed>
void editFields(Struct& target, Changed&& changed) {
  [[maybe_unused]] static const Struct usual{};
  forEachField<Struct>(
      [&](const auto& field) { editField(field, target.*field.member, usual.*field.member, changed); });
}
/// Edits the fields of a shape.
template <class Changed>
void editFields(Shape& shape, Changed&& changed) {
  editEachField(shape, [&](const AnyField& field, auto& value) { editField(field, value, changed); });
}
/// Edits the fields of a light.
template <class Changed>
void editFields(Light& light, Changed&& changed) {
  const Light usual(light.type());
  editEachField(light, [&]<class Value>(const LightField& field, Value& value) {
    const Value* other = nullptr;
    if constexpr (std::is_same_v<Value, Real>) other = findValue<Real>(usual, field.keyword);
    editField(field, value, other ? *other : value, changed);
  });
}

// ------------------------------------------------------------------------------------------------------

/// An edit of a list.
struct ListEdit {
  enum class What { nothing, remove, repeat } what = What::nothing;
  std::size_t index = 0;
};
/// The number of elements, to be unfolded; true if they are to be drawn.
bool beginList(std::size_t count);
/// The buttons of element `index`; the element's widget comes after them.
void listButtons(std::size_t index, ListEdit& edit);
/// The button of an empty list.
bool addButton();

template <class Element>
bool editValue(const FieldFacts& facts, std::vector<Element>& values) {
  if (values.empty()) {
    if (!addButton()) return false;
    values.emplace_back();
    return true;
  }
  if (!beginList(values.size())) return false;
  bool changed = false;
  ListEdit edit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    listButtons(i, edit);
    ImGui::BeginGroup();
    changed = editValue(facts, values[i]) || changed;
    ImGui::EndGroup();
    ImGui::PopID();
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(edit.index);
  if (edit.what == ListEdit::What::remove) values.erase(at);
  if (edit.what == ListEdit::What::repeat) values.insert(at + 1, Element(*at));
  return changed || edit.what != ListEdit::What::nothing;
}

}  // namespace trace::studio
