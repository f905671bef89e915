// The tab Tree of the panel Rays: each ray below the one that sent it.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>

#include "app/explain/ray_words.h"
#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr int kMostIndented = 12;      // levels: deeper rays stand at the same margin
constexpr float kWordsInFour = 48;     // characters that four columns need
constexpr float kRowsWithNumbers = 7;  // rows of a table that leaves room for a line below it

/// Behind the row of the ray at fault.
ImU32 faultColour(const Studio& studio) {
  const ImVec4& c = studio.palette().changed;
  return ImGui::GetColorU32(ImVec4(c.x, c.y, c.z, 0.3f));
}

/// How far each level is indented: less where the deepest of them would push its name out of the column.
float indentOf(const TracedPixel& pixel, float column) {
  const int deepest = pixel.level.empty() ? 0 : *std::max_element(pixel.level.begin(), pixel.level.end());
  const float levels = static_cast<float>(std::clamp(deepest, 1, kMostIndented));
  const float room = std::max(0.0f, column - ImGui::GetTreeNodeToLabelSpacing() - characters(8));
  return std::min(ImGui::GetFontSize() * 0.75f, room / levels);
}

/// The arrow keys have just come to the last item, which is in the row of this ray.
bool reachedByKey(RaysView& view, int ray) {
  if (!ImGui::IsItemFocused() || std::exchange(view.keyRow, ray) == ray) return false;
  return ImGui::GetIO().NavVisible;
}

/// With so much room left free below it.
void drawTreeTable(Studio& studio, const TracedPixel& pixel, const std::vector<int>& rows, float below) {
  RaysView& view = studio.rays;
  const std::vector<RayNode>& nodes = pixel.tree().nodes;
  // Where its sentences would be cut to a word, the last column goes: the row's tooltip has them.
  const bool ends = ImGui::GetContentRegionAvail().x >= characters(kWordsInFour);
  if (std::exchange(view.focusTree, false)) ImGui::SetNextWindowFocus();
  if (!ImGui::BeginTable(ends ? "tree" : "narrow tree", ends ? 4 : 3, kRayTable, {0, -below})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("ray", ImGuiTableColumnFlags_WidthStretch, ends ? 0.38f : 0.55f);
  ImGui::TableSetupColumn("hit", ImGuiTableColumnFlags_WidthStretch, ends ? 0.34f : 0.45f);
  ImGui::TableSetupColumn("adds", ImGuiTableColumnFlags_WidthFixed, characters(ends ? 9 : 7));
  if (ends) ImGui::TableSetupColumn("ended", ImGuiTableColumnFlags_WidthStretch, 0.28f);
  columnHeads({"its kind and its secondary rays", "the object, light or medium that it came to",
               "the luminance that it adds to this sample: its radiance times its weight there",
               "why it ended, or how it continues"},
              ends ? 4 : 3);
  if (const auto found = std::find(rows.begin(), rows.end(), view.scrollTo); found != rows.end()) {
    const float height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    const float top = static_cast<float>(found - rows.begin()) * height, room = ImGui::GetWindowHeight();
    if (top < ImGui::GetScrollY() || top + 2 * height > ImGui::GetScrollY() + room)
      ImGui::SetScrollY(std::max(0.0f, top - room / 2));
  }
  view.scrollTo = -1;
  float eachLevel = -1;  // once the column is known
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.size()));
  while (clipper.Step())
    for (int r = clipper.DisplayStart; r < clipper.DisplayEnd; ++r) {
      const int i = rows[static_cast<std::size_t>(r)];
      const auto n = static_cast<std::size_t>(i);
      const RayNode& node = nodes[n];
      ImGui::PushID(i);
      ImGui::TableNextRow();
      if (i == pixel.why.ray) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, faultColour(studio));
      if (i == view.hoveredBefore)
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, ImGui::GetColorU32(ImGuiCol_FrameBgHovered));
      ImGui::TableNextColumn();
      const ImVec2 start = ImGui::GetCursorPos();
      const bool chosen =
          ImGui::Selectable("##row", i == view.selected,
                            ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap);
      const bool overRow = ImGui::IsItemHovered();
      bool reached = reachedByKey(view, i);
      if (i == view.selected) ImGui::SetItemDefaultFocus();
      landmark("ray " + std::to_string(i));
      if (i == pixel.why.ray) {  // also where it is selected
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + 0.25f * ImGui::GetFontSize(), high.y},
                                                  ImGui::GetColorU32(studio.palette().changed));
      }
      if (eachLevel < 0) eachLevel = indentOf(pixel, ImGui::GetContentRegionAvail().x);
      const float indent = static_cast<float>(std::min(pixel.level[n], kMostIndented)) * eachLevel;
      ImGui::SetCursorPos({start.x + indent, start.y});
      ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_NoTreePushOnOpen;
      if (!pixel.hasChildren[n]) flags |= ImGuiTreeNodeFlags_Leaf;
      ImGui::SetNextItemOpen(!view.closed[n]);
      ImGui::PushStyleColor(ImGuiCol_Text, rayColour(studio, pixel, i));
      const float room = ImGui::GetContentRegionAvail().x - ImGui::GetTreeNodeToLabelSpacing();
      const bool open = ImGui::TreeNodeEx("##node", flags, "%s", shortened(rayName(pixel, i), room).c_str());
      ImGui::PopStyleColor();
      reached = reachedByKey(view, i) || reached;
      if (ImGui::IsItemToggledOpen())
        view.closed[n] = !open;
      else if (chosen || reached || ImGui::IsItemClicked())
        view.selected = i;
      if (overRow || ImGui::IsItemHovered()) {
        view.hovered = i;
        if (ImGui::IsMouseDoubleClicked(0)) studio.raysTab = "Ray";
        if (!ends) ImGui::SetTooltip("%s", sentence(node, pixel.scene()).c_str());
      }
      ImGui::TableNextColumn();
      cutText(metBy(pixel.tree(), pixel.scene(), i));
      ImGui::TableNextColumn();
      if (node.kind != RayKind::light && (view.step < 0 || pixel.isKnown(i, view.step))) {
        ImGui::Text("%.4f", share(pixel.tree(), i));
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", channels(addedLight(pixel.tree(), i)).c_str());
      }
      if (ends) {
        ImGui::TableNextColumn();
        rowName(shortEnd(node));
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", sentence(node, pixel.scene()).c_str());
      }
      ImGui::PopID();
    }
  ImGui::EndTable();
}

}  // namespace

void drawTree(Studio& studio, const TracedPixel& pixel) {
  RaysView& view = studio.rays;
  const std::vector<RayNode>& nodes = pixel.tree().nodes;
  std::vector<int> rows;
  int closed = -1;  // the level of a closed node whose children are passed over
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (closed >= 0 && pixel.level[n] > closed) continue;
    closed = view.closed[n] ? pixel.level[n] : -1;
    if (view.inStep(i)) rows.push_back(i);
  }
  const bool any = view.selected >= 0;
  const bool below =
      any && ImGui::GetContentRegionAvail().y > kRowsWithNumbers * ImGui::GetTextLineHeightWithSpacing();
  drawTreeTable(studio, pixel, rows, below ? ImGui::GetFrameHeightWithSpacing() : 0);
  if (!below) return;
  if (ImGui::Button("Numbers")) studio.raysTab = "Ray";
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("all that is known of the selected ray (double click on its row)");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, rayColour(studio, pixel, view.selected));
  cutText(sentence(rayAt(pixel.tree(), view.selected), pixel.scene()));
  ImGui::PopStyleColor();
}

}  // namespace trace::studio
