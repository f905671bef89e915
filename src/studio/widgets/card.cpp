#include "studio/widgets/card.h"

#include <algorithm>
#include <cmath>

#include "studio/widgets/field_editor.h"

namespace trace::studio {

float cardHeight(float picture) {
  return picture + ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().FramePadding.x;
}

CardRow cardsAcross(float least, int most) {
  const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
  const float count = std::clamp(std::floor((room + gap) / (least + gap)), 1.0f, static_cast<float>(most));
  return {static_cast<int>(count), std::floor((room - gap * (count - 1)) / count)};
}

bool drawCard(const std::string& id, const std::string& title, const Texture* picture, ImVec2 size) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), whole{size.x, cardHeight(size.y)};
  const float pad = ImGui::GetStyle().FramePadding.x;
  const bool pressed = ImGui::InvisibleButton(id.c_str(), whole);
  if (!ImGui::IsItemVisible()) return pressed;
  const bool over = ImGui::IsItemHovered() || ImGui::IsItemFocused();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + whole.x, at.y + whole.y};
  list.AddRectFilled(at, end, ImGui::GetColorU32(over ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg), 4);
  if (picture && !picture->empty()) {
    const float own = static_cast<float>(picture->width()) / static_cast<float>(picture->height()),
                card = size.x / size.y;
    const float across = std::min(1.0f, card / own), down = std::min(1.0f, own / card);
    list.AddImageRounded(picture->id(), at, {at.x + size.x, at.y + size.y},
                         {0.5f - across / 2, 0.5f - down / 2}, {0.5f + across / 2, 0.5f + down / 2},
                         IM_COL32_WHITE, 4, ImDrawFlags_RoundCornersTop);
  }
  list.AddText({at.x + pad, at.y + size.y + pad}, ImGui::GetColorU32(ImGuiCol_Text),
               shortened(title, size.x - 2 * pad).c_str());
  return pressed;
}

}  // namespace trace::studio
