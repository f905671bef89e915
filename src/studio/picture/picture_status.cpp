// The lines below the picture: progress, the pixel under the cursor, samples and noise.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/view/picture_views.h"
#include "scene/integrators.h"
#include "studio/picture/picture_parts.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

/// How many samples there are, and how far their mean is from the truth.
void drawConvergence(const Studio& studio, const BackgroundRender::State& state) {
  const PictureView& view = studio.picture;
  const bool known = view.convergence.samples > 0 && state.phase != BackgroundRender::Phase::failed;
  if (!known || !(state.working() || view.convergence.samples > 1)) return ImGui::TextUnformatted(" ");
  const bool denoises = view.convergence.judged && studio.workspace.document.settings().denoise;
  const std::string text = convergenceText(view.convergence) + (denoises ? ", before denoise" : "");
  const float curve = characters(12), wide = ImGui::CalcTextSize(text.c_str()).x;
  const bool room = curve + ImGui::GetStyle().ItemSpacing.x + wide <= ImGui::GetContentRegionAvail().x;
  if (view.noise.size() > 1 && room) {  // how noise falls
    const float most = *std::max_element(view.noise.begin(), view.noise.end());
    ImGui::PlotLines("##noise", view.noise.data(), static_cast<int>(view.noise.size()), 0, nullptr, 0, most,
                     {curve, ImGui::GetFrameHeight()});
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip(
          "the noise of the picture since the render began: the standard error of a pixel's mean, on "
          "the average, in levels of 255; at the top %.3g",
          most);
    ImGui::SameLine();
  }
  ImGui::AlignTextToFramePadding();
  const bool cut = wide > ImGui::GetContentRegionAvail().x;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  rowName(text);
  ImGui::PopStyleColor();
  if (cut && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
  landmark("convergence");
}

}  // namespace

void drawStatus(Studio& studio, bool hovered, int x, int y) {
  const PictureView& view = studio.picture;
  Workspace& workspace = studio.workspace;
  const BackgroundRender::State state = workspace.render.state();
  if (state.working()) {
    char text[96];
    const std::string left = state.remaining ? ", " + durationText(*state.remaining) + " left" : "";
    if (hovered && state.fraction > 0)
      std::snprintf(text, sizeof text, "%.0f %%", std::floor(100 * state.fraction));
    else if (state.phase == BackgroundRender::Phase::building && state.fraction > 0)
      std::snprintf(text, sizeof text, "%s, %.0f %%",
                    hasTrait(workspace.document.settings(), Trait::photons) ? "sending photons" : "preparing",
                    std::floor(100 * state.fraction));
    else if (state.phase == BackgroundRender::Phase::building)
      std::snprintf(text, sizeof text, "building");
    else if (state.phase == BackgroundRender::Phase::denoising)
      std::snprintf(text, sizeof text, "taking noise out");
    else
      std::snprintf(text, sizeof text, "%.0f %%, %s%s", std::floor(100 * state.fraction),
                    durationText(state.elapsed).c_str(), left.c_str());
    ImGui::ProgressBar(static_cast<float>(state.fraction),
                       {characters(hovered ? 8 : 28), ImGui::GetFrameHeight()}, text);
    ImGui::SameLine();
  }
  ImGui::AlignTextToFramePadding();
  if (hovered) {
    ImGui::Text("%d, %d", x, y);
    const Color c = view.levels.at(x, y);
    const Rounding rounding = workspace.document.settings().rounding;
    ImGui::SameLine(0, characters(2));
    const Color clamped = clamp01(c);
    const float side = ImGui::GetFontSize(), line = ImGui::GetCursorPosY();
    ImGui::SetCursorPosY(line + ImGui::GetStyle().FramePadding.y);
    ImGui::ColorButton(
        "##colour",
        {static_cast<float>(clamped.r), static_cast<float>(clamped.g), static_cast<float>(clamped.b), 1},
        ImGuiColorEditFlags_NoTooltip, {side, side});
    ImGui::SameLine();
    ImGui::SetCursorPosY(line);
    ImGui::AlignTextToFramePadding();
    std::string ofWhat = studio.rays.pyramid.alone ? "all ways  " : "";
    if (const PlaneView& plane = view.planeMade;
        ofWhat.empty() && view.showsPlane() && sameSize(plane.values, view.shown))
      ofWhat = plane.scale.text(plane.values.at(x, y).r) + "   ";
    // A file without linear colours is compared with what the tone makes of the picture.
    const bool linear = !workspace.reference() || workspace.referenceIsLinear();
    std::string text = ofWhat + pixelText(linear ? view.shown.at(x, y) : clamped, c, rounding);
    if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x)
      text.resize(text.find("   ("));  // the levels
    ImGui::TextUnformatted(text.c_str());
    if (workspace.reference() && sameSize(view.reference, view.shown)) {
      Picture there(1, 1);
      there.at(0, 0) = view.reference.at(x, y);
      const Color shown = linear ? developed(there, view.development).at(0, 0) : there.at(0, 0);
      const bool differs = view.view == View::difference || view.view == View::falseColour;
      std::string apart;
      if (differs && sameSize(view.difference, view.shown))
        apart = "   difference  " + channels(view.difference.at(x, y));
      ImGui::TextDisabled("reference  %s%s%s", pixelText(there.at(0, 0), shown, rounding).c_str(),
                          linear ? "" : "   both as shown, 0 to 1", apart.c_str());
    }
  } else if (const double share = workspace.savingShare(); share > 0) {
    char text[40];
    std::snprintf(text, sizeof text, "writing, %.0f %%", std::floor(100 * share));
    ImGui::ProgressBar(static_cast<float>(share), {characters(24), ImGui::GetFrameHeight()}, text);
    ImGui::SameLine();
    if (ImGui::Button("Give up")) workspace.stopSaving();
    landmark("give up writing");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("write no film");
  } else if (workspace.saving() || workspace.reading()) {
    ImGui::TextDisabled(workspace.saving() ? "writing the file" : "reading the file");
  } else if (state.working()) {
    ImGui::TextUnformatted(" ");
  } else if (state.phase == BackgroundRender::Phase::failed) {
    ImGui::TextColored(studio.palette().error, "failed: see the log%s",
                       view.shown.width > 0 ? "; the picture is the one before" : "");
  } else if (view.shown.width > 0) {
    const bool finished = state.phase == BackgroundRender::Phase::finished;
    ImGui::TextDisabled("%d x %d, %s after %s%s", view.shown.width, view.shown.height,
                        finished ? "finished" : "stopped", durationText(state.elapsed).c_str(),
                        workspace.stale() ? "; the scene has changed since: F5 renders" : "");
  } else {
    ImGui::TextUnformatted(" ");
  }
  drawConvergence(studio, state);
}

}  // namespace trace::studio
