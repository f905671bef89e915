// Widgets for the fields that the structs of a scene list (base/field.h): one for each type of value.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "base/text.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace::studio {

/// What a widget needs to know of the field.
struct FieldFacts {
  std::string_view unit;
  double least = -kNoLimit, most = kNoLimit;
};

// Each draws the widget and returns true when the value has changed.
bool editValue(const FieldFacts& facts, Real& value);
bool editValue(const FieldFacts& facts, int& value);
bool editValue(const FieldFacts& facts, bool& value);
bool editValue(const FieldFacts& facts, Vec3& value);
bool editValue(const FieldFacts& facts, Color& value);
bool editValue(const FieldFacts& facts, std::string& value);

template <class T>
concept Editable = requires(const FieldFacts facts, T value) {
  editValue(facts, value);
};

/// Begins a two-column table of names and values; false if it is not to be seen.
bool beginFields(const char* id);
void endFields();
/// The name in the first column, with its help; the widget comes into the second.
void fieldName(std::string_view name, std::string_view help, const std::string& range = {});
std::string rangeText(const FieldFacts& facts);

/// All fields of the struct; calls changed(keyword) after a change. Between beginFields() and endFields().
template <class Struct, class Changed>
void editFields(Struct& target, Changed&& changed) {
  forEachField<Struct>([&](const auto& field) {
    const FieldFacts facts{field.unit, field.least, field.most};
    ImGui::PushID(field.keyword.data());
    fieldName(field.keyword, field.help, rangeText(facts));
    auto& value = target.*field.member;
    if constexpr (Editable<std::remove_cvref_t<decltype(value)>>) {
      if (editValue(facts, value)) changed(field.keyword);
    } else {
      ImGui::TextDisabled("edited in the file");
    }
    ImGui::PopID();
  });
}

}  // namespace trace::studio
