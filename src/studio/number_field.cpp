#include "studio/number_field.h"

#include <imgui.h>
// For GetItemID and TempInputIsActive, which tell that a slider takes text.
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "app/typed_value.h"
#include "studio/landmarks.h"

namespace trace::studio {
namespace {

/// What the widget made of the last item's value: `shown`, if it says `changed`.
template <class Value>
bool settle(Value& value, const Value& shown, bool changed, bool typing) {
  static TypedValue<Value> typed;  // as Dear ImGui keeps the text of the one field that takes it
  const ImGuiID id = ImGui::GetItemID();
  std::optional<Value> now;
  if (changed) now = shown;
  if (typing || typed.holds(id)) {
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    now = typed.update(id, ImGui::GetFrameCount(), typing, escaped, std::move(now));
  }
  if (!now || *now == value) return false;
  value = *now;
  return true;
}

template <class Value>
bool edit(const char* id, ImGuiDataType type, Value& value, Value least, Value most, const NumberLook& look) {
  ImGuiSliderFlags flags = look.clamped ? ImGuiSliderFlags_AlwaysClamp : 0;
  if (look.logarithmic) flags |= ImGuiSliderFlags_Logarithmic;
  Value shown = value;
  const bool changed =
      look.speed > 0
          ? ImGui::DragScalar(id, type, &shown, look.speed, &least, &most, look.format.c_str(), flags)
          : ImGui::SliderScalar(id, type, &shown, &least, &most, look.format.c_str(), flags);
  return settle(value, shown, changed, ImGui::TempInputIsActive(ImGui::GetItemID()));
}

}  // namespace

bool editNumber(const char* id, double& value, const NumberLook& look) {
  // Dear ImGui takes no infinite bounds.
  const double least = std::max(look.least, -1e300), most = std::min(look.most, 1e300);
  double now = value;
  if (!edit(id, ImGuiDataType_Double, now, least, most, look) || !std::isfinite(now)) return false;
  value = now;
  return true;
}

bool editNumber(const char* id, int& value, const NumberLook& look) {
  constexpr double kMost = 2147483647;
  return edit(id, ImGuiDataType_S32, value, static_cast<int>(std::max(look.least, -kMost)),
              static_cast<int>(std::min(look.most, kMost)), look);
}

bool editNumbersInRow(double* values, int count, const NumberLook& look) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x, room = ImGui::GetContentRegionAvail().x;
  const float width =
      std::max(1.0f, std::floor((room - gap * static_cast<float>(count - 1)) / static_cast<float>(count)));
  bool changed = false;
  ImGui::BeginGroup();
  for (int i = 0; i < count; ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    ImGui::PushID(i);
    ImGui::SetNextItemWidth(i + 1 < count ? width : -1);
    changed = editNumber("##value", values[i], look) || changed;
    landmark("number " + std::to_string(i));
    ImGui::PopID();
  }
  ImGui::EndGroup();
  return changed;
}

bool editText(const char* id, std::string& value, const char* hint) {
  std::string shown = value;
  const bool changed = ImGui::InputTextWithHint(id, hint, &shown);
  return settle(value, shown, changed, ImGui::IsItemActive());
}

}  // namespace trace::studio
