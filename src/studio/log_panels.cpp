// The panels Log, Bad samples and Statistics: what came of it.
#include <imgui.h>

#include <algorithm>
#include <string>

#include "studio/panels.h"

namespace trace::studio {
namespace {

using Level = Workspace::LogEntry::Level;
constexpr ImGuiTableFlags kLogTable =
    ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;

void tableRow(std::initializer_list<std::string> cells) {
  ImGui::TableNextRow();
  for (const std::string& cell : cells) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(cell.c_str());
  }
}

}  // namespace

void drawLog(Studio& studio) {
  const auto& log = studio.workspace.log();
  static std::size_t seen = 0;
  ImGui::BeginChild("entries");
  for (const Workspace::LogEntry& entry : log) {
    const Palette& palette = studio.palette();
    ImGui::PushTextWrapPos();
    if (!entry.place.file.empty()) {
      std::string place = entry.place.file;
      if (entry.place.line > 0)
        place += ":" + std::to_string(entry.place.line) + ":" + std::to_string(entry.place.column);
      ImGui::TextColored(palette.accent, "%s", place.c_str());
    }
    const bool bad = entry.level != Level::note;
    const char* level = entry.level == Level::error ? "error: " : bad ? "warning: " : "";
    const ImVec4 colour = entry.level == Level::error ? palette.error
                          : bad                       ? palette.warning
                                                      : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted((level + entry.text).c_str());
    ImGui::PopStyleColor();
    if (!entry.place.text.empty()) ImGui::TextDisabled("    %s", entry.place.text.c_str());
    if (!entry.hint.empty()) ImGui::TextDisabled("    %s", entry.hint.c_str());
    ImGui::PopTextWrapPos();
  }
  if (log.size() != seen) {
    ImGui::SetScrollHereY(1);
    seen = log.size();
  }
  ImGui::EndChild();
  if (ImGui::BeginPopupContextWindow()) {
    if (ImGui::MenuItem("Clear")) studio.workspace.clearLog();
    ImGui::EndPopup();
  }
}

void showBadSample(Studio& studio, const BadSample& bad) {
  studio.rays.sample = bad.sample;
  studio.picture.goTo(bad.x, bad.y);
  studio.show("Rays");
}

void drawBadSamples(Studio& studio) {
  const RenderResult result = studio.workspace.render.result();
  if (result.badSamples.empty())
    return ImGui::TextDisabled("every sample of the last finished render was a number");
  ImGui::TextColored(studio.palette().warning, "%llu samples were not finite and left out of the picture",
                     static_cast<unsigned long long>(result.statistics.badSamples));
  if (!ImGui::BeginTable("samples", 3, kLogTable)) return;
  ImGui::TableSetupColumn("pixel");
  ImGui::TableSetupColumn("sample");
  ImGui::TableSetupColumn("");
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(result.badSamples.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const BadSample& bad = result.badSamples[static_cast<std::size_t>(i)];
      tableRow({std::to_string(bad.x) + ", " + std::to_string(bad.y), std::to_string(bad.sample)});
      ImGui::TableNextColumn();
      ImGui::PushID(i);
      if (ImGui::SmallButton("Show its rays")) showBadSample(studio, bad);
      ImGui::PopID();
    }
  ImGui::EndTable();
}

void drawStatistics(Studio& studio) {
  const auto session = studio.workspace.render.session();
  const RenderResult result = studio.workspace.render.result();
  if (!session || result.statistics.allRays() == 0) return ImGui::TextDisabled("nothing was rendered yet");
  const Statistics& s = result.statistics;
  if (!ImGui::BeginTable("statistics", 3, kLogTable)) return;
  ImGui::TableSetupColumn("what");
  ImGui::TableSetupColumn("count");
  ImGui::TableSetupColumn("hits");
  ImGui::TableHeadersRow();
  for (std::size_t i = 0; i < s.rays.size(); ++i)
    tableRow({std::string(kRayLooks[i].kind) + " rays", std::to_string(s.rays[i]), ""});
  for (const ShapeType& type : shapeTypes())
    if (s.tests[type.index] > 0)
      tableRow({std::string(type.keyword) + " tests", std::to_string(s.tests[type.index]),
                std::to_string(s.hits[type.index])});
  tableRow({"hierarchy nodes visited", std::to_string(s.nodes.count), ""});
  ImGui::EndTable();
}

}  // namespace trace::studio
