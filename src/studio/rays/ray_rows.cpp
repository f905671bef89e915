#include "studio/rays/ray_rows.h"

#include "studio/widgets/field_editor.h"

namespace trace::studio {

ImVec4 rayColour(const Studio& studio, const TracedPixel& pixel, int ray) {
  const Color c = colourOfWords(pixel.looks(ray), studio.theme.light);
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1};
}

const char* rayName(const TracedPixel& pixel, int ray) { return look(pixel.looks(ray)).name.data(); }

void columnHeads(std::initializer_list<const char*> help, int most) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  int column = 0;
  for (const char* text : help) {
    if (column == most) break;
    ImGui::TableSetColumnIndex(column);
    ImGui::TableHeader(ImGui::TableGetColumnName(column++));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
  }
}

void cutText(const std::string& text) {
  const bool cut = ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x;
  rowName(text);
  if (cut && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace trace::studio
