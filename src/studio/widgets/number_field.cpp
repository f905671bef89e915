#include "studio/widgets/number_field.h"

#include <imgui.h>
// For what is typed into a slider: Dear ImGui's own field drops letters without a word.
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "app/editing/typed_value.h"
#include "base/field.h"
#include "base/text.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

std::vector<std::string>& remarks() {
  static std::vector<std::string> all;  // as Dear ImGui keeps the text of the one field that takes it
  return all;
}

/// An edit of a value.
template <class Value>
struct Settled {
  std::optional<Value> value{};
  bool typed = false;
};

/// The new value of the widget: `shown`, if it says `changed`.
template <class Value>
Settled<Value> settle(ImGuiID id, const Value& shown, bool changed, bool typing) {
  static TypedValue<Value> typed;
  std::optional<Value> now;
  if (changed) now = shown;
  if (!typing && !typed.holds(id)) return {std::move(now), false};
  const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  return {typed.update(id, ImGui::GetFrameCount(), typing, escaped, std::move(now)), true};
}

std::string numberRange(const NumberLook& look, bool whole) {
  const std::string number = whole ? "a whole number" : "a number";
  const std::string word = look.words.least.empty() ? "" : std::string(look.words.least) + ", or ";
  const bool below = look.least > -kNoLimit && look.clamped, above = look.most < kNoLimit && look.clamped;
  if (below && above) return word + toText(look.least) + " to " + toText(look.most);
  if (below) return word + toText(look.least) + " or more";
  return above ? toText(look.most) + " or less" : number;
}

void remark(const NumberLook& look, bool whole, const std::string& found, const std::string& became) {
  remarks().push_back(std::string(look.name) + (look.name.empty() ? "" : ": ") + "expected " +
                      numberRange(look, whole) + ", found " + found + "; " + became);
}

/// The typed number as it is taken, with a remark if that is not as it was typed; nothing if it is not.
std::optional<double> taken(double typed, const NumberLook& look, bool whole) {
  double now = whole ? std::round(typed) : typed;
  if (look.clamped) now = std::clamp(now, look.least, look.most);
  const bool any = std::isfinite(now);
  if (!any || now != typed)
    remark(look, whole, toText(typed), any ? "the nearest is " + toText(now) : "not taken");
  if (!any) return {};
  return now;
}

/// Half of the world writes a comma there.
std::string commaHint(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return "";
  text[comma] = '.';
  const std::optional<ParsedNumber> number = parseNumber(text);
  return number && number->length == text.size() ? "; a point stands before decimals: " + text : "";
}

/// The number that was typed; nothing, with a remark, if it is none.
std::optional<double> numberIn(const std::string& typed, const NumberLook& look, bool whole) {
  const std::size_t first = typed.find_first_not_of(" \t");
  if (first == std::string::npos) {
    remark(look, whole, "nothing", "the value stays");
    return {};
  }
  const std::string text = typed.substr(first, typed.find_last_not_of(" \t") + 1 - first);
  if (const std::optional<double> meant = look.words.meaning(text, look.least)) return meant;
  const std::optional<ParsedNumber> number = parseNumber(text);
  if (number && number->length == text.size()) return taken(number->value, look, whole);
  remark(look, whole, '"' + text + '"', "not taken" + commaHint(text));
  return {};
}

/// A slider that takes text, in place of Dear ImGui's own field.
Settled<std::string> typeNumber(const char* label, ImGuiID id) {
  constexpr int kMostCharacters = 32;  // as Dear ImGui's own field, which begins what continues here
  static ImGuiID owner = 0;
  static char text[kMostCharacters];
  const char* before = ImGui::GetCurrentContext()->InputTextState.InitialTextA.Data;
  if (std::exchange(owner, id) != id) std::snprintf(text, sizeof text, "%s", before);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImRect box(at, {at.x + ImGui::CalcItemWidth(), at.y + ImGui::GetFrameHeight()});
  ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
  if (!ImGui::ItemAdd(box, id, &box, ImGuiItemFlags_Inputable)) return {};
  ImGui::TempInputText(box, id, label, text, kMostCharacters, ImGuiInputTextFlags_AutoSelectAll);
  const std::string now = text;
  const bool typing = ImGui::TempInputIsActive(id), changed = now != std::string(before);
  if (!typing) owner = 0;
  return settle(id, now, changed, typing);
}

bool editNumberField(const char* label, double& value, const NumberLook& given, bool whole) {
  const ImGuiID id = ImGui::GetID(label);
  NumberLook look = given;
  if (std::isinf(value)) look.words.unlimited = value;
  const auto take = [&](const std::optional<double>& now) {
    if (!now || *now == value || std::isnan(*now)) return false;
    value = *now;
    return true;
  };
  const auto takeTyped = [&](const Settled<std::string>& typed) {
    return typed.value && take(numberIn(*typed.value, look, whole));
  };
  if (ImGui::TempInputIsActive(id)) return takeTyped(typeNumber(label, id));
  // Dear ImGui takes no infinite bounds.
  const double least = std::max(look.least, -1e300), most = std::min(look.most, 1e300);
  char full[64];
  std::snprintf(full, sizeof full, look.format.c_str(), value);
  const float room = ImGui::CalcItemWidth() - ImGui::GetStyle().FramePadding.x / 2;
  const std::string_view word = look.words.of(value, look.least);
  const std::string text =
      !word.empty() ? std::string(word) : shortNumber(value, look.format, [room](const std::string& spelt) {
        return ImGui::CalcTextSize(spelt.c_str()).x <= room;
      });
  const bool shortened = text != full;  // then it stands over the widget's own text, with which typing begins
  const std::string format = !shortened ? look.format : whole ? "%.0f" : "%.15g";
  const ImGuiSliderFlags flags = (look.logarithmic ? ImGuiSliderFlags_Logarithmic : 0) |
                                 (shortened && !whole ? ImGuiSliderFlags_NoRoundToFormat : 0);
  double shown = value;
  if (shortened) ImGui::PushStyleColor(ImGuiCol_Text, 0);
  const bool changed = look.speed > 0 ? ImGui::DragScalar(label, ImGuiDataType_Double, &shown, look.speed,
                                                          &least, &most, format.c_str(), flags)
                                      : ImGui::SliderScalar(label, ImGuiDataType_Double, &shown, &least,
                                                            &most, format.c_str(), flags);
  if (shortened) {
    ImGui::PopStyleColor();
    if (!ImGui::TempInputIsActive(id))
      ImGui::RenderTextClipped(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), text.c_str(), nullptr,
                               nullptr, {0.5f, 0.5f});
    if (word.empty() && ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
      const std::size_t unit = look.format.find(' ', look.format.find("%."));
      ImGui::SetTooltip("%s%s", toText(value).c_str(),
                        unit == std::string::npos ? "" : look.format.substr(unit).c_str());
    }
  }
  const Settled<std::string> typed = settle(id, std::string(), false, ImGui::TempInputIsActive(id));
  if (typed.typed) return takeTyped(typed);
  return changed && take(shown);
}

/// One less, the number, one more: without the buttons where the number would have no room.
bool editCount(const char* label, double& value, const NumberLook& look) {
  const float width = ImGui::CalcItemWidth(), side = ImGui::GetFrameHeight(), gap = 1;
  const float field = width - 2 * (side + gap);
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  if (field < ImGui::CalcTextSize("000").x + 2 * pad.x || ImGui::TempInputIsActive(ImGui::GetID(label)))
    return editNumberField(label, value, look, true);
  const auto step = [&](const char* name, double by, const char* help) {
    const double next = value + by;
    ImGui::BeginDisabled(next < look.least || next > look.most);
    ImGui::PushID(label);
    const bool pressed = ImGui::Button(name, {side, 0});
    ImGui::PopID();
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    if (pressed) value = next;
    return pressed;
  };
  ImGui::BeginGroup();
  bool changed = step("-", -1, "one less");
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(field);
  changed = editNumberField(label, value, look, true) || changed;
  ImGui::SameLine(0, gap);
  changed = step("+", 1, "one more") || changed;
  ImGui::EndGroup();
  return changed;
}

}  // namespace

bool editNumber(const char* id, double& value, const NumberLook& look) {
  return editNumberField(id, value, look, false);
}

bool editNumber(const char* id, int& value, const NumberLook& look) {
  constexpr double kMostInt = 2147483647;
  NumberLook inRange = look;
  inRange.least = std::max(look.least, -kMostInt);
  inRange.most = std::min(look.most, kMostInt);
  double number = value;
  if (!(look.counted ? editCount(id, number, inRange) : editNumberField(id, number, inRange, true)))
    return false;
  const int now = static_cast<int>(std::lround(number));
  return std::exchange(value, now) != now;
}

void remarkOn(std::string what) { remarks().push_back(std::move(what)); }

std::string unitAfter(std::string_view unit, double number) {
  std::string text(unit);
  if (number == 1) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 1 && text[end - 1] == 's') text.erase(end - 1, 1);
  }
  return text.empty() ? "" : " " + text;
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
  Settled<std::string> now = settle(ImGui::GetItemID(), shown, changed, ImGui::IsItemActive());
  if (!now.value || *now.value == value) return false;
  value = std::move(*now.value);
  return true;
}

}  // namespace trace::studio
