// The tab Pyramid of the panel Rays: what each way of `bdpt` brings to the whole picture.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/picture_views.h"
#include "studio/landmarks.h"
#include "studio/number_field.h"
#include "studio/rays_view.h"
#include "studio/studio.h"

namespace trace::studio {
namespace {

constexpr int kLeastPlaces = 2, kMostPlaces = 8;
constexpr ImU32 kLetters = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kPlate = IM_COL32(0, 0, 0, 170);  // behind letters on a picture, which may be bright

/// The pictures on the graphics card, as the picture itself is shown.
void refreshPyramid(Studio& studio, bool changed) {
  PyramidView& view = studio.rays.pyramid;
  const Settings settings = studio.workspace.shownSettings();
  const Development development = developmentOf(settings);
  if (!changed && view.exposure == studio.picture.exposure && view.development == development) return;
  view.exposure = studio.picture.exposure;
  view.development = development;
  const std::vector<WayPicture>& pictures = view.maker.pyramid().pictures;
  view.textures.resize(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!view.textures[i]) view.textures[i] = std::make_unique<Texture>();
    view.textures[i]->set(
        exposed(developed(pictures[i].picture, development), view.exposure, settings.rounding));
  }
}

/// Shows this way alone in the whole picture, or all again.
void showWay(Studio& studio, const WayPicture& way, bool shown) {
  for (const auto& [option, places] :
       {std::pair("light-vertices", way.light), std::pair("camera-vertices", way.camera)}) {
    if (shown)
      studio.workspace.reset(option);
    else
      studio.workspace.choose(option, std::to_string(places));
  }
}

void pyramidCell(Studio& studio, const WayPicture& way, const Texture& texture, ImVec2 size) {
  const Settings& now = studio.workspace.document.settings();
  const bool shown = now.lightVertices == way.light && now.cameraVertices == way.camera;
  const std::string name = std::to_string(way.light) + " + " + std::to_string(way.camera);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton(name.c_str(), size)) showWay(studio, way, shown);
  landmark("pyramid " + std::to_string(way.light) + " " + std::to_string(way.camera));
  const ImVec2 end{at.x + size.x, at.y + size.y};
  ImGui::GetWindowDrawList()->AddImage(texture.id(), at, end);
  if (shown)
    ImGui::GetWindowDrawList()->AddRect(at, end, ImGui::GetColorU32(studio.palette().accent), 0, 0, 2);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%d %s from the light's end (s), %d from the camera's (t)\nclick: %s", way.light,
                      way.light == 1 ? "place" : "places", way.camera,
                      shown ? "all ways in the picture again" : "this way alone in the picture");
  const ImVec2 text = ImGui::CalcTextSize(name.c_str());
  if (size.x < text.x + 6 || size.y < 1.5f * text.y) return;
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + text.x + 6, at.y + text.y + 2}, kPlate);
  ImGui::GetWindowDrawList()->AddText({at.x + 3, at.y + 1}, kLetters, name.c_str());
}

}  // namespace

void drawPyramid(Studio& studio, const TracedPixel&) {
  PyramidView& view = studio.rays.pyramid;
  view.open = true;
  const auto session = studio.workspace.render.session();
  const bool waits = studio.workspace.render.state().working();  // for the picture, which comes first
  waits ? view.maker.giveUp() : view.maker.want(session, view.unweighted, view.places);
  refreshPyramid(studio, view.maker.update());
  ImGui::Checkbox("unweighted", &view.unweighted);
  landmark("pyramid unweighted");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("each way alone, as if no other found such paths; else with what it counts");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  editNumber("##places", view.places, {kLeastPlaces, kMostPlaces, "paths of up to %.0f places"});
  const Pyramid& pyramid = view.maker.pyramid();
  if (!pyramid.problem.empty())
    return ImGui::TextColored(studio.palette().error, "%s", pyramid.problem.c_str());
  if (waits && pyramid.pictures.empty())
    ImGui::TextDisabled("The ways are rendered when the picture is finished.");
  else if (view.maker.busy())
    ImGui::TextDisabled("The ways are being rendered.");
  if (pyramid.pictures.empty() || view.textures.size() != pyramid.pictures.size()) return;
  const float gap = 4;
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const Picture& first = pyramid.pictures.front().picture;
  const float aspect = static_cast<float>(first.width) / static_cast<float>(std::max(1, first.height));
  const auto rows = static_cast<float>(pyramid.places - 1);
  const float high = std::max(24.0f, std::floor(all.y / rows) - gap);  // all of it is to be seen
  const float wide = std::floor(all.x / static_cast<float>(pyramid.places)) - gap;
  const ImVec2 size{std::min(wide, high * aspect), std::min(wide, high * aspect) / aspect};
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
  std::size_t next = 0;
  const float left = ImGui::GetCursorPosX();
  for (int places = 2; places <= pyramid.places; ++places)
    for (int s = 0; s < places && next < pyramid.pictures.size(); ++s, ++next) {
      if (s > 0)
        ImGui::SameLine(0, gap);
      else
        ImGui::SetCursorPosX(left + (all.x - static_cast<float>(places) * (size.x + gap)) / 2);
      pyramidCell(studio, pyramid.pictures[next], *view.textures[next], size);
    }
  ImGui::PopStyleVar();
}

}  // namespace trace::studio
