// The tab Chain of the panel Rays: a chain of `mlt`, move by move.
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

void chooseMove(RaysView& view, int index, int count) {
  view.chainMove = std::clamp(index, 0, count - 1);
  view.revealMove = true;
}

void moveRow(RaysView& view, const ChainMove& move, int index, const ImVec4& muted) {
  ImGui::PushID(index);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const bool chosen = index == view.chains.index();
  const std::string name = move.number < 0 ? "start" : std::to_string(move.number);
  if (ImGui::Selectable(name.c_str(), chosen, ImGuiSelectableFlags_SpanAllColumns)) view.chainMove = index;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", sentence(move).c_str());
  if (!move.made) ImGui::PushStyleColor(ImGuiCol_Text, muted);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(look(move.kind).name.data());
  ImGui::TableNextColumn();
  ImGui::Text("%d, %d", move.x, move.y);
  ImGui::TableNextColumn();
  cutText(channels(move.brings));
  ImGui::TableNextColumn();
  ImGui::Text("%.3g", move.light);
  ImGui::TableNextColumn();
  ImGui::Text("%s, %.2g", move.made ? "yes" : "no", move.chance);
  if (!move.made) ImGui::PopStyleColor();
  ImGui::PopID();
}

}  // namespace

void drawChain(Studio& studio, const TracedPixel&) {
  RaysView& view = studio.rays;
  const ChainWalk& walk = *view.chains.walk();
  const auto count = static_cast<int>(walk.moves.size());
  if (ImGui::ArrowButton("move back", ImGuiDir_Left)) chooseMove(view, view.chains.index() - 1, count);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::ArrowButton("move on", ImGuiDir_Right)) chooseMove(view, view.chains.index() + 1, count);
  landmark("move on");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  cutText(walk.summary());
  if (!ImGui::BeginTable("moves", 6, kRayTable)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("move", ImGuiTableColumnFlags_WidthFixed, characters(5));
  const bool named = changesPaths(studio.workspace.shownSettings());  // mutations have longer names
  ImGui::TableSetupColumn("goes", ImGuiTableColumnFlags_WidthFixed, characters(named ? 13 : 8));
  ImGui::TableSetupColumn("pixel", ImGuiTableColumnFlags_WidthFixed, characters(8));
  ImGui::TableSetupColumn("brings", ImGuiTableColumnFlags_WidthStretch, 0.6f);
  ImGui::TableSetupColumn("light", ImGuiTableColumnFlags_WidthFixed, characters(6));
  ImGui::TableSetupColumn("made", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  columnHeads({"its number in the chain",
               "small step: each random number changes a little; large step: all are replaced; or the "
               "mutation of vertices",
               "to which the offered path brings most of its light",
               "red, green and blue of its contribution there",
               "how bright it is to the chain: the luminance of all that it brings, to other pixels too",
               "whether the move was accepted, and its acceptance probability: the brightness relative to "
               "the current path"});
  if (std::exchange(view.revealMove, false)) {
    const float height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
    ImGui::SetScrollY(
        std::max(0.0f, static_cast<float>(view.chains.index()) * height - ImGui::GetWindowHeight() / 2));
  }
  ImGuiListClipper clipper;
  clipper.Begin(count);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      moveRow(view, walk.moves[static_cast<std::size_t>(i)], i, studio.palette().muted);
  ImGui::EndTable();
}

}  // namespace trace::studio
