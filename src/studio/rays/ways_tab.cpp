// The tab Ways of the panel Rays: in which ways a sample of `bdpt` joined its path from the camera with the
// one from a light, what each counts, and its path in space.
#include <imgui.h>

#include <cstdio>
#include <utility>

#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

/// One of the table's rows.
void wayRow(Studio& studio, const TracedPixel& pixel, int index) {
  const PathWay& way = pixel.ways[static_cast<std::size_t>(index)];
  ImGui::PushID(index);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  char label[32];
  std::snprintf(label, sizeof label, "%d + %d", way.light, way.camera);
  const std::string how = sentence(way, pixel.tree(), pixel.scene());
  const bool chosen = index == studio.rays.way;
  if (ImGui::Selectable(label, chosen, ImGuiSelectableFlags_SpanAllColumns))
    chooseWay(studio, chosen ? -1 : index);
  if (chosen && std::exchange(studio.rays.revealWay, false)) ImGui::SetScrollHereY();
  if (index < 16) landmark("way " + std::to_string(index));
  const bool here = way.camera > 1;  // else it is of another pixel
  const std::string alone = here ? "\nalone it would bring " + channels(way.alone()) : "";
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "%d %s chosen from the light's end (s), %d from the camera's, itself among them (t)\n%s%s\n"
        "click: this path alone in space",
        way.light, way.light == 1 ? "place" : "places", way.camera, how.c_str(), alone.c_str());
  ImGui::TableNextColumn();
  if (here) ImGui::Text("%.1f %%", 100 * way.share);
  ImGui::TableNextColumn();
  if (here) cutText(channels(way.brings));
  ImGui::TableNextColumn();
  cutText(how);
  ImGui::PopID();
}

}  // namespace

void chooseWay(Studio& studio, int way) {
  RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  view.way = -1;
  view.wayRays.clear();
  if (!pixel || way < 0 || static_cast<std::size_t>(way) >= pixel->ways.size()) return;
  view.way = way;
  view.revealWay = true;
  view.wayRays = raysOf(pixel->tree(), pixel->ways[static_cast<std::size_t>(way)]);
}

void drawWays(Studio& studio, const TracedPixel& pixel) {
  if (pixel.ways.empty()) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("%s", whyNoWays(pixel.tree(), pixel.session->settings()).c_str());
    ImGui::PopTextWrapPos();
    return landmark("no ways");
  }
  if (!ImGui::BeginTable("ways", 4, kRayTable)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("s + t", ImGuiTableColumnFlags_WidthFixed, characters(6));
  ImGui::TableSetupColumn("counts", ImGuiTableColumnFlags_WidthFixed, characters(7));
  ImGui::TableSetupColumn("brings", ImGuiTableColumnFlags_WidthFixed, characters(22));
  ImGui::TableSetupColumn("how", ImGuiTableColumnFlags_WidthStretch);
  columnHeads({"vertices from the light, and from the camera",
               "its MIS weight among all strategies for this path",
               "red, green and blue of its contribution to the pixel", "how its two ends were joined"});
  int places = 0;
  for (int i = 0; i < static_cast<int>(pixel.ways.size()); ++i) {
    const int now = pixel.ways[static_cast<std::size_t>(i)].places();
    if (now != places) {
      Color sum;
      for (const PathWay& way : pixel.ways)
        if (way.places() == now) sum += way.brings;
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(studio.palette().accent, "%d places", now);
      ImGui::TableNextColumn();
      ImGui::TableNextColumn();
      ImGui::PushStyleColor(ImGuiCol_Text, studio.palette().accent);
      cutText(channels(sum));
      ImGui::PopStyleColor();
      places = now;
    }
    wayRow(studio, pixel, i);
  }
  ImGui::EndTable();
}

}  // namespace trace::studio
