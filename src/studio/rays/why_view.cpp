// Why the chosen pixel has its colour, in the panel Rays: a sentence, the sum as swatches, and buttons that
// cure.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "app/view/ray_story.h"
#include "studio/panels.h"
#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

/// As the picture would show the light.
ImVec4 swatchColour(const Color& light, const Settings& settings) {
  const Color c = shownColour(light, settings);
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1};
}

/// On this line if it fits, else on the next.
void beside(float wide) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < wide) ImGui::NewLine();
}

void drawCures(Studio& studio, const TracedPixel& pixel) {
  const std::vector<WhyCure>& cures = pixel.why.cures;
  if (cures.empty()) return;
  bool first = true;
  const auto next = [&](const std::string& label, const char* help) {
    if (!std::exchange(first, false))
      beside(ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x);
    const bool pressed = ImGui::Button(label.c_str());
    landmark("cure " + label);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return pressed;
  };
  const WhyCure last = cures.back();
  for (const WhyCure& each : cures)
    if (next(each.label, each.object ? "show it in the panel Scene" : "try it; Ctrl+Z undoes it"))
      return cure(studio, pixel, each, false);
  if (!last.option.empty() &&
      next("Pin and try " + last.label, "keep these rays, and compare them in the tab Difference"))
    cure(studio, pixel, last, true);
}

}  // namespace

void drawSum(Studio& studio, const TracedPixel& pixel) {
  const std::vector<WhySummand>& sum = pixel.why.sum;
  if (sum.empty()) return;
  const Settings& settings = pixel.session->settings();
  const int step = studio.rays.step;
  const float side = ImGui::GetTextLineHeight();
  const auto swatch = [&](const char* id, const std::string& name, const Color& color,
                          const char* sign = "") {
    ImGui::PushStyleColor(ImGuiCol_Border,
                          ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));  // dark ones are seen
    const bool pressed =
        ImGui::ColorButton(id, swatchColour(color, settings),
                           ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {side, side});
    ImGui::PopStyleColor();
    const bool over = ImGui::IsItemHovered();
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::TextUnformatted((name + sign).c_str());
    if (over || ImGui::IsItemHovered())
      ImGui::SetTooltip("%s: %s", name == "=" ? "the sum" : name.c_str(), channels(color).c_str());
    return pressed || ImGui::IsItemClicked();
  };
  const float gaps = side + 2 * ImGui::GetStyle().ItemInnerSpacing.x + characters(3);
  const Color whole = pixel.tree().nodes.front().radiance;
  swatch("##sum", "=", step < 0 || step >= static_cast<int>(studio.rays.rays) ? whole : sumAfter(sum, step));
  landmark("sum");
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const std::string& name = sum[i].brief;
    const char* sign = i + 1 < sum.size() ? "  +" : "";
    beside(gaps + ImGui::CalcTextSize((name + sign).c_str()).x);
    ImGui::PushID(static_cast<int>(i));
    constexpr float kToCome = 0.3f;
    const bool there = step < 0 || sum[i].last < step;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * (there ? 1 : kToCome));
    if (swatch("##term", name, there ? sum[i].color : Color(0), sign) && sum[i].ray >= 0)
      studio.rays.selected = studio.rays.scrollTo = sum[i].ray;
    ImGui::PopStyleVar();
    ImGui::PopID();
  }
}

void cure(Studio& studio, const TracedPixel&, const WhyCure& by, bool pins) {
  if (by.object) {
    studio.select(Studio::Selected::object, *by.object);
    studio.show("Scene");
    return;
  }
  if (pins) {
    studio.workspace.inspector.pin(true);
    studio.raysTab = "Difference";
  }
  studio.workspace.choose(std::string(by.option), by.value);
}

void drawWhy(Studio& studio, const TracedPixel& pixel) {
  const PixelWhy& why = pixel.why;
  if (why.sentence.empty()) return;
  ImGui::TextColored(why.ray >= 0 ? studio.palette().changed : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%s",
                     inLines(why.sentence, ImGui::GetContentRegionAvail().x).c_str());
  landmark("why");
  if (ImGui::IsItemClicked() && why.ray >= 0) studio.rays.selected = studio.rays.scrollTo = why.ray;
  if (!studio.rays.pyramid.open) drawSum(studio, pixel);
  drawCures(studio, pixel);
}

}  // namespace trace::studio
