#include "studio/number_field.h"

#include <imgui.h>
// For GetItemID and TempInputIsActive, which tell that a slider takes text.
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/typed_value.h"
#include "base/field.h"
#include "base/text.h"
#include "studio/landmarks.h"

namespace trace::studio {
namespace {

std::vector<std::string>& remarks() {
  static std::vector<std::string> all;  // as Dear ImGui keeps the text of the one field that takes it
  return all;
}

/// What a person made of a value.
template <class Value>
struct Settled {
  std::optional<Value> value{};
  bool typed = false;
};

/// What the widget made of the last item's value: `shown`, if it says `changed`.
template <class Value>
Settled<Value> settle(const Value& shown, bool changed, bool typing) {
  static TypedValue<Value> typed;
  const ImGuiID id = ImGui::GetItemID();
  std::optional<Value> now;
  if (changed) now = shown;
  if (!typing && !typed.holds(id)) return {std::move(now), false};
  const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  return {typed.update(id, ImGui::GetFrameCount(), typing, escaped, std::move(now)), true};
}

std::string rangeText(const NumberLook& look, bool whole) {
  const std::string number = whole ? "a whole number" : "a number";
  const bool below = look.least > -kNoLimit && look.clamped, above = look.most < kNoLimit && look.clamped;
  if (below && above) return toText(look.least) + " to " + toText(look.most);
  if (below) return toText(look.least) + " or more";
  return above ? toText(look.most) + " or less" : number;
}

/// The typed number as it is taken, with a remark if that is not as it was typed; nothing if it is not.
std::optional<double> taken(double typed, const NumberLook& look, bool whole) {
  double now = whole ? std::round(typed) : typed;
  if (look.clamped) now = std::clamp(now, look.least, look.most);
  const bool any = std::isfinite(now);
  if (!any || now != typed)
    remarks().push_back(std::string(look.name) + (look.name.empty() ? "" : ": ") + "expected " +
                        rangeText(look, whole) + ", found " + toText(typed) +
                        (any ? "; the nearest is " + toText(now) : "; not taken"));
  if (!any) return {};
  return now;
}

bool edit(const char* id, double& value, const NumberLook& look, bool whole) {
  // Dear ImGui takes no infinite bounds.
  const double least = std::max(look.least, -1e300), most = std::min(look.most, 1e300);
  const ImGuiSliderFlags flags = look.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
  double shown = value;
  const bool changed = look.speed > 0 ? ImGui::DragScalar(id, ImGuiDataType_Double, &shown, look.speed,
                                                          &least, &most, look.format.c_str(), flags)
                                      : ImGui::SliderScalar(id, ImGuiDataType_Double, &shown, &least, &most,
                                                            look.format.c_str(), flags);
  Settled<double> now = settle(shown, changed, ImGui::TempInputIsActive(ImGui::GetItemID()));
  if (now.value && now.typed) now.value = taken(*now.value, look, whole);
  if (!now.value || *now.value == value || !std::isfinite(*now.value)) return false;
  value = *now.value;
  return true;
}

}  // namespace

bool editNumber(const char* id, double& value, const NumberLook& look) {
  return edit(id, value, look, false);
}

bool editNumber(const char* id, int& value, const NumberLook& look) {
  constexpr double kMost = 2147483647;
  NumberLook inRange = look;
  inRange.least = std::max(look.least, -kMost), inRange.most = std::min(look.most, kMost);
  double number = value;
  if (!edit(id, number, inRange, true)) return false;
  const int now = static_cast<int>(std::lround(number));
  return std::exchange(value, now) != now;
}

std::vector<std::string> takeRemarks() { return std::exchange(remarks(), {}); }

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
  Settled<std::string> now = settle(shown, changed, ImGui::IsItemActive());
  if (!now.value || *now.value == value) return false;
  value = std::move(*now.value);
  return true;
}

}  // namespace trace::studio
