// The buttons above the picture, and what stands in its place while there is none.
#include <algorithm>
#include <cmath>

#include "app/view/picture_views.h"
#include "studio/actions.h"
#include "studio/picture/picture_parts.h"
#include "studio/widgets/drag.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {

namespace {

/// Or on the next line.
void roomFor(float wide) {
  if (ImGui::GetContentRegionAvail().x < wide) ImGui::NewLine();
}

/// The list of views of the render: the picture, a heat map, or a pass.
void choosePlane(Studio& studio) {
  PictureView& view = studio.picture;
  const std::string now = view.pass.empty() ? kPlaneNames[static_cast<int>(view.plane)] : view.pass;
  const bool open = ImGui::BeginCombo("##plane", now.c_str());
  if (open) {
    for (std::size_t i = 0; i < std::size(kPlaneNames); ++i) {
      const bool chosen = view.pass.empty() && view.plane == static_cast<FilmPlane>(i);
      if (ImGui::Selectable(kPlaneNames[i], chosen)) {
        view.plane = static_cast<FilmPlane>(i);
        view.pass.clear();
      }
    }
    if (const auto session = studio.workspace.render.session())
      for (const std::string_view pass : passesToSee(session->settings()))
        if (ImGui::Selectable(std::string(pass).c_str(), view.pass == pass)) view.pass = pass;
    ImGui::EndCombo();
  }
  landmark("plane");
  if (!open && ImGui::IsItemHovered()) {
    besideItem();
    ImGui::SetTooltip(
        "the picture, how many rays each pixel has, how much noise is left in it, what denoise changed, how "
        "much work a sample is, or one of the render's `passes`");
  }
}

/// Switches for those who compare: the channel, and the histogram, if there is one.
void drawComparing(PictureView& view, bool histogram) {
  ImGui::SameLine();
  roomFor(characters(13));
  ImGui::SetNextItemWidth(characters(13));
  int channel = static_cast<int>(view.channel);
  if (ImGui::Combo("##channel", &channel, kChannelNames, static_cast<int>(std::size(kChannelNames))))
    view.channel = static_cast<ShownChannel>(channel);
  landmark("channel");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("all channels, or one of them as grey");
  ImGui::SameLine();
  roomFor(ImGui::GetFrameHeight() + ImGui::CalcTextSize("histogram").x + ImGui::GetStyle().ItemSpacing.x);
  ImGui::BeginDisabled(!histogram);  // else what follows would move
  ImGui::Checkbox("histogram", &view.histogramShown);
  ImGui::EndDisabled();
  landmark("histogram");
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip(histogram ? "how many pixels have each level of what is seen"
                                : "only of one picture, or of the difference of two");
}

}  // namespace

void drawBar(Studio& studio) {
  constexpr float kExposure = 12.5f, kPlane = 12, kOneLine = 58;  // characters
  PictureView& view = studio.picture;
  const bool open = studio.workspace.document.isOpen();
  const auto button = [&](const char* name, const char* tip, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(name);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", tip);
    ImGui::SameLine();
    return pressed;
  };
  const bool working = studio.workspace.render.state().working();
  if (!working && button("Render", "render the scene as it is now (F5)", open))
    studio.workspace.startRender();
  if (working && button(" Stop ", "stop; finished parts stay (Esc)", true)) studio.workspace.render.stop();
  const auto runAction = [&](const char* name) {
    for (const Action& action : actions())
      if (std::string_view(action.name) == name) action.run(studio);
  };
  // Where it would push others to the next line, the menu has it.
  if (ImGui::GetContentRegionAvail().x > characters(kOneLine) &&
      button("Export...", "write the picture to a file (Ctrl+E)", !view.pictureTexture.empty()))
    runAction("Export picture...");
  if (button("Fit", "the whole picture (F)", true)) view.fit = true;
  if (button("1:1", "one pixel to one of the screen (A)", true)) {
    view.fit = false;
    view.zoom = 1;
  }

  roomFor(characters(kExposure));
  ImGui::SetNextItemWidth(characters(kExposure));
  ImGui::DragFloat("##exposure", &view.exposure, 0.02f, -6, 6,
                   view.exposure == 0 ? "exposure 0" : "exposure %+.1f");
  escapable(view.exposure);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("drag: stops, powers of two; only what is shown, not what is saved\nright click: 0");
  if (ImGui::IsItemClicked(1)) view.exposure = 0;
  ImGui::SameLine();
  roomFor(characters(kPlane));
  ImGui::SetNextItemWidth(characters(kPlane));
  std::optional<Way>& alone = studio.rays.pyramid.alone;
  if (alone) {
    if (ImGui::Button("All ways", {characters(kPlane), 0})) alone.reset();
    landmark("all ways");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("back to the whole picture, from a single strategy");
    return;
  }
  choosePlane(studio);
  if (comparesPictures(studio) && !view.showsPlane())
    drawComparing(view, !studio.workspace.reference() || hasHistogram(view.view));
  if (!studio.workspace.reference()) {
    ImGui::SameLine();
    roomFor(ImGui::CalcTextSize("Compare...").x + 2 * ImGui::GetStyle().FramePadding.x);
    if (ImGui::Button("Compare...")) runAction("Open reference...");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("choose a picture to compare with (Ctrl+Shift+R)");
    return;
  }
  if (view.showsPlane()) return;  // it is not compared
  int index = static_cast<int>(view.view);
  ImGui::SameLine();
  roomFor(characters(20));
  ImGui::SetNextItemWidth(characters(20));
  if (ImGui::Combo("##view", &index, kViewNames, static_cast<int>(std::size(kViewNames))))
    view.view = static_cast<View>(index);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("how the two pictures are shown (C)");
  if (view.view == View::difference || view.view == View::falseColour) {
    ImGui::SameLine();
    roomFor(characters(14));
    ImGui::SetNextItemWidth(characters(14));
    if (ImGui::DragFloat("##magnify", &view.magnify, std::max(0.1f, view.magnify / 100), 1, 255,
                         view.magnifyChosen ? "x %.0f" : "x %.0f, auto"))
      view.magnifyChosen = true;
    escapable(view.magnify);
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("drag: by which differences are magnified\nright click: as many times as shows them");
    if (ImGui::IsItemClicked(1)) view.magnifyChosen = false;
    landmark("magnify");
  }
}

}  // namespace trace::studio
