#include "studio/widgets/landmarks.h"

#include <imgui.h>

namespace trace::studio {
namespace {

struct Kept {
  bool on = false;
  std::string field, focused;
  std::map<std::string, Landmark> places;
};

Kept& kept() {
  static Kept all;  // landmarks of the one window that a program has, as Dear ImGui's own context
  return all;
}

}  // namespace

void keepLandmarks() { kept().on = true; }
void forgetLandmarks() {
  kept().places.clear();
  kept().focused.clear();
}

const std::string& focusedLandmark() { return kept().focused; }

void landmarksOf(const std::string& field) { kept().field = field; }

void landmark(const std::string& name) {
  if (!kept().on) return;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const std::string whole = kept().field.empty() ? name : kept().field + " " + name;
  if (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible) kept().focused = whole;
  if (ImGui::IsItemVisible()) kept().places[whole] = {low.x, low.y, high.x, high.y};
}

const std::map<std::string, Landmark>& landmarks() { return kept().places; }

}  // namespace trace::studio
