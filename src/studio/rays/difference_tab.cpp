// The tab Difference of the panel Rays: the rays of a pixel beside those that were pinned.
#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"

namespace trace::studio {
namespace {

std::string inNumbers(const Color& c) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4f %.4f %.4f", c.r, c.g, c.b);
  return text;
}

/// "73, 42: 0.3832 0.4087 0.4353; its sample 0: 0.6323 0.6212 0.5947".
std::string pixelTitle(const TracedPixel& pixel) {
  const std::string text = std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + ": ";
  const std::vector<Color>& samples = pixel.explanation.samples;
  const auto shown = static_cast<std::size_t>(pixel.sample);
  if (samples.size() < 2 || shown >= samples.size()) return text + inNumbers(pixel.explanation.pixel);
  return text + inNumbers(pixel.explanation.pixel) + "; its sample " + std::to_string(shown) + ": " +
         inNumbers(samples[shown]);
}

}  // namespace

void drawDifference(Studio& studio, const TracedPixel& traced) {
  RaysView& view = studio.rays;
  const TracedPixel* pinned = studio.workspace.inspector.pinned();
  if (!pinned) return ImGui::TextDisabled("Pin keeps these rays, to compare others with them");
  const std::vector<RayPair>& pairs = studio.workspace.inspector.pairs();
  const auto differ = std::count_if(pairs.begin(), pairs.end(), [](const RayPair& p) { return p.differs; });
  cutText("pinned " + pixelTitle(*pinned));
  cutText("now " + pixelTitle(traced));
  ImGui::TextDisabled("%d of %d rays differ", static_cast<int>(differ), static_cast<int>(pairs.size()));
  if (!ImGui::BeginTable("pairs", 3, kRayTable)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("ray", ImGuiTableColumnFlags_WidthStretch, 0.27f);
  ImGui::TableSetupColumn("met now", ImGuiTableColumnFlags_WidthStretch, 0.2f);
  ImGui::TableSetupColumn("difference", ImGuiTableColumnFlags_WidthStretch, 0.53f);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(pairs.size()));
  while (clipper.Step())
    for (int r = clipper.DisplayStart; r < clipper.DisplayEnd; ++r) {
      const RayPair& pair = pairs[static_cast<std::size_t>(r)];
      const TracedPixel& pixel = pair.b >= 0 ? traced : *pinned;
      const int index = pair.b >= 0 ? pair.b : pair.a;
      ImGui::PushID(r);
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      const float indent = static_cast<float>(pair.depth) * ImGui::GetFontSize() * 0.75f;
      if (indent > 0) ImGui::Indent(indent);
      ImGui::PushStyleColor(ImGuiCol_Text, rayColour(studio, pixel, index));
      if (ImGui::Selectable(rayName(pixel, index), pair.b >= 0 && pair.b == view.selected,
                            ImGuiSelectableFlags_SpanAllColumns) &&
          pair.b >= 0)
        view.selected = pair.b;
      ImGui::PopStyleColor();
      if (ImGui::IsItemHovered() && pair.b >= 0) view.hovered = pair.b;
      if (indent > 0) ImGui::Unindent(indent);
      ImGui::TableNextColumn();
      cutText(metBy(pixel.tree(), pixel.scene(), index));
      ImGui::TableNextColumn();
      ImGui::PushStyleColor(ImGuiCol_Text, studio.palette().changed);
      if (pair.differs) cutText(pair.what);
      ImGui::PopStyleColor();
      ImGui::PopID();
    }
  ImGui::EndTable();
}

}  // namespace trace::studio
