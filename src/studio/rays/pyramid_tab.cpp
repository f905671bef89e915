// The tab Pyramid of the panel Rays: what each way of `bdpt` brings to the whole picture; and one of them
// alone, seen in place of the picture.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/view/picture_views.h"
#include "base/text.h"
#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"
#include "studio/studio.h"
#include "studio/widgets/landmarks.h"
#include "studio/widgets/number_field.h"

namespace trace::studio {
namespace {

constexpr int kLeastPlaces = 2, kMostPlaces = 8;
constexpr ImU32 kLetters = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kPlate = IM_COL32(0, 0, 0, 170);      // behind letters on a picture, which may be bright
constexpr ImU32 kPast = IM_COL32(255, 255, 255, 70);  // tint of pictures that are being made anew

/// The pictures on the graphics card, as the picture itself is shown.
void refreshTextures(WayPictures& ways, const PyramidView& view, Rounding rounding) {
  const std::vector<WayPicture>& pictures = ways.maker.pyramid().pictures;
  ways.textures.resize(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!ways.textures[i]) ways.textures[i] = std::make_unique<Texture>();
    ways.textures[i]->set(exposed(developed(pictures[i].picture, view.development), view.exposure, rounding));
  }
}

/// The picture of that strategy, if it is as it should be now.
const Texture* textureOf(const WayPictures& ways, const Way& way) {
  if (!ways.maker.current()) return nullptr;
  const std::vector<WayPicture>& pictures = ways.maker.pyramid().pictures;
  for (std::size_t i = 0; i < pictures.size() && i < ways.textures.size(); ++i)
    if (pictures[i].way == way) return ways.textures[i].get();
  return nullptr;
}

std::string wayName(const Way& way) { return std::to_string(way.light) + " + " + std::to_string(way.camera); }

std::string placesOf(const Way& way) {
  return counted(static_cast<std::size_t>(way.light), "place") + " from the light's end (s), " +
         std::to_string(way.camera) + " from the camera's (t)";
}

/// A line that says what the pictures are, or why they are not there.
std::string standing(const Studio& studio) {
  const PyramidView& view = studio.rays.pyramid;
  if (view.waits) return "They are made when the picture is finished.";
  if (!view.all.maker.current()) return "They are being made.";
  if (view.unweighted) return "Each as if it were the only strategy: they do not add up.";
  const Pyramid& pyramid = view.all.maker.pyramid();
  constexpr double kLeast = 1e-6;  // what sums of this many pixels are exact to
  if (pyramid.longer < kLeast) return "No longer path brings light: these add up to the picture.";
  char text[96];
  std::snprintf(text, sizeof text, "Longer paths bring %.2g %% of the picture's light.",
                100 * pyramid.longer);
  return text;
}

void pyramidCell(Studio& studio, const Way& way, const Texture& texture, ImVec2 size) {
  PyramidView& view = studio.rays.pyramid;
  const bool shown = view.alone == way, current = view.all.maker.current();
  const std::string name = wayName(way);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton(name.c_str(), size)) view.alone = shown ? std::nullopt : std::optional(way);
  landmark("pyramid " + std::to_string(way.light) + " " + std::to_string(way.camera));
  const ImVec2 end{at.x + size.x, at.y + size.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, end, IM_COL32(0, 0, 0, 255));
  list.AddImage(texture.id(), at, end, {0, 0}, {1, 1}, current ? kLetters : kPast);
  if (shown) list.AddRect(at, end, ImGui::GetColorU32(studio.palette().accent), 0, 0, 2);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s%s\nclick: %s", placesOf(way).c_str(),
                      current ? "" : "\nfrom before the change: it is being rendered again",
                      shown ? "the whole picture again" : "this strategy alone in place of the picture");
  const ImVec2 text = ImGui::CalcTextSize(name.c_str());
  if (size.x < 1.5f * text.x || size.y < 2 * text.y) return;  // the picture matters more
  list.AddRectFilled(at, {at.x + text.x + 6, at.y + text.y + 2}, kPlate);
  list.AddText({at.x + 3, at.y + 1}, kLetters, name.c_str());
}

void drawCells(Studio& studio) {
  const WayPictures& ways = studio.rays.pyramid.all;
  const Pyramid& pyramid = ways.maker.pyramid();
  if (pyramid.pictures.empty()) return;
  const float gap = 4;
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const Picture& first = pyramid.pictures.front().picture;
  const float aspect = static_cast<float>(first.width) / static_cast<float>(std::max(1, first.height));
  const int most = pyramid.plan.places;
  const float high = std::max(12.0f, std::floor(all.y / static_cast<float>(most - 1)) - gap);
  const float wide = std::floor(all.x / static_cast<float>(most)) - gap;
  const ImVec2 size{std::min(wide, high * aspect), std::min(wide, high * aspect) / aspect};
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
  const float left = ImGui::GetCursorPosX();
  for (std::size_t i = 0; i < pyramid.pictures.size(); ++i) {
    const Way& way = pyramid.pictures[i].way;
    const auto places = static_cast<float>(way.light + way.camera);
    if (way.light > 0)
      ImGui::SameLine(0, gap);
    else
      ImGui::SetCursorPosX(left + (all.x - places * (size.x + gap)) / 2);
    pyramidCell(studio, way, *ways.textures[i], size);
  }
  ImGui::PopStyleVar();
}

}  // namespace

void updateWays(Studio& studio) {
  PyramidView& view = studio.rays.pyramid;
  auto session = studio.workspace.render.session();
  view.waits = studio.workspace.render.state().working();
  if (view.waits) session.reset();
  if (session && !showsStrategies(session->settings())) view.alone.reset();
  if (view.open || view.alone) view.all.maker.want({session, view.unweighted, view.places});
  view.one.maker.want(view.alone ? PyramidPlan{session, view.unweighted, 0, view.alone} : PyramidPlan{});
  const Settings settings = studio.workspace.shownSettings();
  const bool tone = view.exposure != studio.picture.exposure || view.development != developmentOf(settings);
  view.exposure = studio.picture.exposure;
  view.development = developmentOf(settings);
  for (WayPictures* ways : {&view.all, &view.one})
    if (ways->maker.update() || tone) refreshTextures(*ways, view, settings.rounding);
}

InPlaceOfPicture wayAlone(const Studio& studio) {
  const PyramidView& view = studio.rays.pyramid;
  if (!view.alone) return {};
  const std::string name = wayName(*view.alone) + (view.unweighted ? " alone, unweighted" : " alone");
  if (const Texture* texture = textureOf(view.one, *view.alone))
    return {texture, name + ": " + placesOf(*view.alone)};
  if (view.one.maker.current()) return {nullptr, view.one.maker.pyramid().problem};
  if (const Texture* texture = textureOf(view.all, *view.alone))
    return {texture, name + ", coarse; it is being made"};
  return {nullptr,
          "all ways; " + name + (view.waits ? " is made when the picture is finished" : " is being made")};
}

void drawPyramid(Studio& studio, const TracedPixel&) {
  PyramidView& view = studio.rays.pyramid;
  view.open = true;
  ImGui::Checkbox("unweighted", &view.unweighted);
  landmark("pyramid unweighted");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("each strategy alone at full weight; else with its MIS weight");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  editNumber("##places", view.places,
             {.least = kLeastPlaces,
              .most = kMostPlaces,
              .format = "paths of up to %.0f vertices",
              .speed = 0.05f,
              .counted = true});
  const std::string& problem = view.all.maker.pyramid().problem;
  ImGui::PushStyleColor(ImGuiCol_Text, problem.empty() ? studio.palette().muted : studio.palette().error);
  cutText(problem.empty() ? standing(studio) : problem);
  ImGui::PopStyleColor();
  landmark("pyramid standing");
  drawCells(studio);
}

}  // namespace trace::studio
