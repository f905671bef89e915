#include "studio/stage.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/explain/ray_words.h"
#include "studio/actions.h"
#include "studio/panels.h"
#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"
#include "studio/studio.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

/// The ray that was reached in words, or why the pixel has its colour.
void drawCaption(Studio& studio) {
  const RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  const float room = ImGui::GetContentRegionAvail().x;
  const std::string keys = "Space: the next ray. P: all, one after the other. Z: magnify. F11 or Esc: back.";
  if (!pixel) {
    ImGui::TextDisabled("%s", inLines("Click on the picture. " + keys, room).c_str());
  } else {
    const std::string sample = sampleText(*pixel), of = sample.empty() ? "" : "  (" + sample + ")";
    const int ray = view.step - 1;
    if (view.step > 0 && ray < static_cast<int>(view.rays)) {
      const std::string count = std::to_string(view.step) + " of " + std::to_string(view.rays) + "  ";
      ImGui::TextColored(rayColour(studio, *pixel, ray), "%s",
                         inLines(count + stepOf(pixel->tree(), pixel->scene(), ray) + of, room).c_str());
    } else {
      ImGui::TextUnformatted(inLines(pixel->why.sentence + of, room).c_str());
    }
    drawSum(studio, *pixel);
    if (ImGui::GetContentRegionAvail().y >= ImGui::GetTextLineHeight() && view.step < 0)
      ImGui::TextDisabled("%s", shortened(keys, room).c_str());
  }
  landmark("stage caption");
}

}  // namespace

void toggleStage(Studio& studio) {
  studio.stage = !studio.stage;
  studio.themeChanged = true;  // all is larger on it
  studio.magnification = 1;
}

void stepOnStage(Studio& studio) {
  RaysView& view = studio.rays;
  if (!shownPixel(studio)) return;
  if (view.step >= static_cast<int>(view.rays))
    view.step = -1;
  else
    stepRays(studio, 1);
}

void drawStage(Studio& studio) {
  takeKeys(studio);
  const ImGuiViewport& window = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(window.Pos);
  ImGui::SetNextWindowSize(window.Size);
  ImGui::Begin("stage", nullptr,
               ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  updateRays(studio);
  const float below = 3 * ImGui::GetTextLineHeightWithSpacing();
  const ImVec2 room = ImGui::GetContentRegionAvail(), gap = ImGui::GetStyle().ItemSpacing;
  const bool wide = room.x > room.y;
  const ImVec2 half = wide ? ImVec2{std::floor((room.x - gap.x) / 2), room.y - below}
                           : ImVec2{room.x, std::floor((room.y - below - gap.y) / 2)};
  ImGui::BeginChild("stage picture", half, false,
                    ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  drawPictureAlone(studio);
  ImGui::EndChild();
  if (wide) ImGui::SameLine();
  ImGui::BeginChild("stage space", half, false, ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  studio.rays.hovered = -1;
  drawSpace(studio);
  studio.rays.hoveredBefore = studio.rays.hovered;
  ImGui::EndChild();
  drawCaption(studio);
  ImGui::End();
}

}  // namespace trace::studio
