#include "studio/rays/ray_rows.h"

#include "studio/widgets/field_editor.h"

namespace trace::studio {

ImVec4 rayColour(const Studio& studio, const TracedPixel& pixel, int ray) {
  const Color c = colourOf(pixel.looks(ray), studio.theme.light);
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1};
}

const char* rayName(const TracedPixel& pixel, int ray) { return look(pixel.looks(ray)).name.data(); }

std::string metBy(const TracedPixel& pixel, int ray) {
  const RayNode& node = pixel.tree().nodes[static_cast<std::size_t>(ray)];
  if (const MediumTerm* medium = scatteredIn(node))
    return medium->object == Filling::kAir ? "fog" : objectName(pixel.scene(), medium->object);
  if (node.hit) return objectName(pixel.scene(), node.hit->object);
  for (const RayEnd& end : node.ends)
    if (const auto* stop = std::get_if<Blocked>(&end)) return objectName(pixel.scene(), stop->object);
  const Term* term = termOf(pixel.tree(), ray);
  return term && term->light ? lightName(pixel.scene(), term->light->light) : "";
}

void columnHeads(std::initializer_list<const char*> help) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  int column = 0;
  for (const char* text : help) {
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
