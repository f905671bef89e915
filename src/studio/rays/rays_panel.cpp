// The panel Rays: the rays of the pixel that was clicked in the picture, in space (space_view.cpp) and as a
// table; the numbers of one; steps through the tracing; the hierarchy boxes of one; what differs from a
// pinned pixel.
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/view/ray_drawing.h"
#include "app/view/ray_story.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "scene/integrators.h"
#include "scene/picture_size.h"
#include "studio/panels.h"
#include "studio/rays/ray_rows.h"
#include "studio/space/rays_view.h"
#include "studio/widgets/drag.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

void drawHead(Studio& studio, const TracedPixel& pixel) {
  RaysView& view = studio.rays;
  PixelInspector& inspector = studio.workspace.inspector;
  const auto samples = static_cast<int>(pixel.explanation.samples.size());
  const bool roomy = ImGui::GetContentRegionAvail().x >= characters(samples > 1 ? 84 : 60);
  if (samples > 1 || roomy) {
    ImGui::AlignTextToFramePadding();
    ImGui::Text("pixel %d, %d", pixel.x, pixel.y);
    ImGui::SameLine();
  }
  if (samples > 1) {
    ImGui::SetNextItemWidth(characters(18));
    char format[32];
    std::snprintf(format, sizeof format, "sample %%d of %d", samples);
    ImGui::DragInt("##sample", &view.sample, 0.1f, 0, samples - 1, format, ImGuiSliderFlags_AlwaysClamp);
    escapable(view.sample);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("drag: the samples of the pixel, from 0");
    if (roomy) ImGui::SameLine();
  }
  if (ImGui::Button(inspector.pinned() ? "Unpin" : "Pin")) inspector.pin(!inspector.pinned());
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "keep the rays of pixel %d, %d, then click another pixel or change an option: the tab Difference "
        "compares",
        pixel.x, pixel.y);

  const auto count = static_cast<int>(pixel.tree().nodes.size());
  ImGui::SameLine();
  if (ImGui::Button(view.playsAt >= 0 ? "Stop" : "Play")) playRays(studio);
  landmark("play");
  if (ImGui::IsItemHovered() && view.playsAt < 0) {  // while they appear it would hide their number
    besideItem();
    ImGui::SetTooltip("the rays one after the other, in the order of tracing (P)");
  }
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  const auto stepByHand = [&](int rays) {
    view.playsAt = -1;
    stepRays(studio, rays);
  };
  if (ImGui::ArrowButton("back", ImGuiDir_Left)) stepByHand(-1);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("one ray back in the order of tracing");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::ArrowButton("on", ImGuiDir_Right)) stepByHand(1);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the next ray in the order of tracing");
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  int step = view.step < 0 ? count : view.step;
  char format[48];
  std::snprintf(format, sizeof format, view.step < 0 ? "rays: %d, all" : "ray %%d of %d", count);
  const float all = ImGui::CalcTextSize("All").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(
      std::max(characters(10), ImGui::GetContentRegionAvail().x - all - ImGui::GetStyle().ItemSpacing.x));
  const int before = step;
  if (ImGui::DragInt("##step", &step, 0.1f, 1, count, format, ImGuiSliderFlags_AlwaysClamp)) {
    view.step = before;
    stepByHand(step - before);
  }
  ImGui::SameLine();
  if (ImGui::Button("All")) view.step = view.playsAt = -1;
}

void drawBoxes(Studio& studio) {
  RaysView& view = studio.rays;
  if (view.boxesOf != view.selected) {
    if (!ImGui::Button("Show the hierarchy boxes that it visited")) return;
    showBoxes(studio);
  }
  const auto count = static_cast<int>(view.boxes.size());
  if (count == 0) return ImGui::TextDisabled("it visited no box of a hierarchy");
  if (ImGui::ArrowButton("box back", ImGuiDir_Left)) view.box = std::max(1, view.box - 1);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::ArrowButton("box on", ImGuiDir_Right)) view.box = std::min(count, view.box + 1);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  char format[32];
  std::snprintf(format, sizeof format, "box %%d of %d", count);
  ImGui::SetNextItemWidth(-characters(10));
  ImGui::DragInt("##box", &view.box, 0.1f, 1, count, format, ImGuiSliderFlags_AlwaysClamp);
  escapable(view.box);
  ImGui::SameLine();
  if (ImGui::Button("Hide")) view.boxesOf = -1;
}

void drawNumbers(Studio& studio, const TracedPixel& pixel) {
  RaysView& view = studio.rays;
  if (view.selected < 0) return ImGui::TextDisabled("select a ray, in space or in the table");
  const RayNode& node = rayAt(pixel.tree(), view.selected);
  ImGui::PushTextWrapPos();
  ImGui::TextColored(rayColour(studio, pixel, view.selected), "%s ray: %s", rayName(pixel, view.selected),
                     sentence(node, pixel.scene()).c_str());
  ImGui::PopTextWrapPos();
  drawBoxes(studio);
  if (!ImGui::BeginTable("numbers", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY)) return;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 0.4f);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.6f);
  for (const auto& [name, value] : numbersOf(pixel.tree(), view.selected, pixel.scene())) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (value.empty())
      ImGui::TextColored(studio.palette().accent, "%s", name.c_str());
    else
      ImGui::TextDisabled("%s", name.c_str());
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::EndTable();
}

/// Lets the last ray grow; the next one comes when its time has come.
void playOn(Studio& studio) {
  RaysView& view = studio.rays;
  constexpr double kPause = 0.8, kGrowth = 0.5;  // seconds for each ray, and those while it grows
  const double left = view.playsAt - ImGui::GetTime();
  view.grown = view.playsAt < 0 ? 1 : static_cast<float>(std::clamp((kPause - left) / kGrowth, 0.0, 1.0));
  if (view.playsAt < 0 || left > 0) return;
  if (!shownPixel(studio) || view.step >= static_cast<int>(view.rays)) {
    view.step = view.playsAt = -1;
    return;
  }
  stepRays(studio, 1);
  view.playsAt = ImGui::GetTime() + kPause;
  view.grown = 0;
}

}  // namespace

const TracedPixel* shownPixel(const Studio& studio) {
  if (const TracedPixel* offered = studio.rays.chains.offered()) return offered;
  const TracedPixel* traced = studio.workspace.inspector.traced();
  return traced && traced->problem.empty() ? traced : nullptr;
}

void playRays(Studio& studio) {
  RaysView& view = studio.rays;
  if (view.playsAt >= 0) {
    view.playsAt = -1;
    return;
  }
  view.step = 0;
  view.playsAt = ImGui::GetTime();
}

void saveRays(Studio& studio, const std::string& file) {
  const TracedPixel& pixel = *shownPixel(studio);
  studio.workspace.saveBy(file, [file, session = pixel.session, tree = pixel.tree()](const Advance&) {
    const Drawing drawing =
        drawRays(session->sceneOf(tree), session->settings(), session->worldOf(tree), tree);
    writeDrawing(file, drawing);
  });
}

void saveStory(Studio& studio, const std::string& file) {
  const TracedPixel& pixel = *shownPixel(studio);
  const Real aspect = studio.rays.aspect;
  const Document& document = studio.workspace.document;
  const Camera camera = studio.rays.fromCamera ? cameraFor(document.scene(), document.settings())
                                               : cameraOf(studio.rays.orbit.frame(aspect), aspect);
  studio.workspace.saveBy(file, [file, pixel, camera](const Advance& advance) {
    writeStory(file, RayStory(pixel, camera), advance);
  });
}

void stepRays(Studio& studio, int rays) {
  RaysView& view = studio.rays;
  const auto count = static_cast<int>(view.rays);
  const int from = view.step >= 0 ? view.step : rays > 0 ? 0 : count;
  view.step = std::clamp(from + rays, 1, std::max(count, 1));
  view.selected = view.scrollTo = std::min(view.step, count) - 1;
}

void showBoxes(Studio& studio) {
  RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  if (!pixel || view.selected < 0) return;
  const Session& session = *pixel->session;
  view.boxes =
      visitedBoxes(session.worldOf(pixel->tree()), session.settings(), rayAt(pixel->tree(), view.selected));
  view.boxesOf = view.selected;
  view.box = static_cast<int>(view.boxes.size());
}

void updateRays(Studio& studio) {
  RaysView& view = studio.rays;
  const PictureView& picture = studio.picture;
  PixelInspector& inspector = studio.workspace.inspector;
  const auto session = studio.workspace.render.session();
  if (session && picture.pixel) {
    const PixelPlace pixel = picture.pixel.in(session->size());
    if (pixel.x != view.clickedX || pixel.y != view.clickedY) view.chainMove = -1;
    if (pixel.x != view.clickedX || pixel.y != view.clickedY) view.frameDue = view.raysFramed;
    view.clickedX = pixel.x;
    view.clickedY = pixel.y;
    inspector.want(session, pixel.x, pixel.y, view.sample);
    view.chains.want(session, pixel.x, pixel.y, view.chainMove);
  } else {
    inspector.want(nullptr, 0, 0, 0);
    view.chains.want(nullptr, 0, 0, -1);
  }
  playOn(studio);
  const bool moved = view.chains.update();
  if (moved && view.chainMove < 0) view.revealMove = true;
  const bool traced = inspector.update();
  if (!moved && !traced) return;
  const TracedPixel* shown = shownPixel(studio);
  if (!shown) return;
  const std::size_t count = shown->tree().nodes.size();
  if (shown->x != view.x || shown->y != view.y || count != view.rays) {
    view.step = -1;
    view.playsAt = -1;
    if (view.differs && !inspector.pinned()) studio.raysTab = "Tree";
    const int fault = shown->why.ray;
    view.selected = fault >= 0 && fault < static_cast<int>(count) ? fault : count > 0 ? 0 : -1;
    view.scrollTo = view.selected;
    view.closed.assign(count, 0);
  }
  chooseWay(studio, -1);
  view.x = shown->x;
  view.y = shown->y;
  view.rays = count;
  view.boxesOf = -1;
}

namespace {

/// The contribution of the light image to the pixel besides its rays; "" where there is none.
std::string lightImageAt(const TracedPixel& pixel) {
  const Film& film = pixel.session->film();
  if (!film.takesSplats() || hasTrait(pixel.session->settings(), Trait::byChains)) return "";
  const Color light = film.ofSplats(pixel.x, pixel.y);
  return "The light image (t = 1) adds " + channels(light) + " to this pixel.";
}

/// A remark on what the pixel's rays do not explain, or which move of a chain they belong to.
std::string noteOn(const RaysView& view, const TracedPixel& pixel) {
  if (!view.chains.offered()) {
    std::string note;
    for (const std::string& each :
         {lightImageAt(pixel), pixel.note,
          std::string(view.chains.busy() ? "A chain that comes by this pixel is looked for." : "")})
      if (!each.empty()) note += (note.empty() ? "" : " ") + each;
    return note;
  }
  const ChainWalk& walk = *view.chains.walk();
  const ChainMove& move = walk.moves[static_cast<std::size_t>(view.chains.index())];
  const std::string which = move.number < 0 ? " " : ", move " + std::to_string(move.number) + ": ";
  return walk.missed() + "A chain of this picture" + which + sentence(move) +
         (view.chains.before() ? ". Grey: where it was." : ".");
}

void drawNote(const Studio& studio, const TracedPixel& pixel) {
  const std::string note = noteOn(studio.rays, pixel);
  if (note.empty()) return;
  ImGui::TextColored(studio.palette().changed, "%s", inLines(note, ImGui::GetContentRegionAvail().x).c_str());
  landmark("note on rays");
  if (!studio.rays.chains.offered() && !lightImageAt(pixel).empty() && ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "paths from lights that the camera sees at their end:\nsamples of all pixels send them, so they are "
        "not "
        "among this pixel's rays");
}

/// The head and the rows that a low window shows of a tree with so many rays.
float heightOfTree(std::size_t rays) {
  const auto rows = static_cast<float>(std::min<std::size_t>(rays, 3));
  return (rows + 1) * (ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y) + 2;
}

}  // namespace

void drawRays(Studio& studio) {
  RaysView& view = studio.rays;
  if (!studio.workspace.document.isOpen()) return ImGui::TextDisabled("no scene is open");
  updateRays(studio);
  view.hovered = -1;
  const PixelInspector& inspector = studio.workspace.inspector;
  const TracedPixel* pixel = shownPixel(studio);
  const float height = ImGui::GetContentRegionAvail().y;
  const bool low = height < 35 * ImGui::GetTextLineHeight();    // then the tree needs every line
  const float least = std::min(characters(30), 0.5f * height);  // below that nothing is recognized
  const float share = !pixel ? 0.88f : low ? 0.34f : view.pyramid.open ? 0.38f : 0.45f;
  float space = std::max(least, share * height);
  if (pixel && low && view.between > 0)
    space =
        std::clamp(height - view.between - heightOfTree(view.rays), std::min(characters(16), space), space);
  ImGui::BeginChild("space", {0, space}, false, ImGuiWindowFlags_NoScrollWithMouse);
  drawSpace(studio);
  ImGui::EndChild();
  const float belowSpace = ImGui::GetCursorPosY();
  if (!inspector.traced()) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled(
        inspector.busy()
            ? "The rays of that pixel are being traced."
            : "Click on the picture: the rays of that pixel appear here, in space and as a tree.");
    ImGui::PopTextWrapPos();
  } else if (!pixel) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(studio.palette().error, "%s", inspector.traced()->problem.c_str());
    ImGui::PopTextWrapPos();
  } else {
    drawHead(studio, *pixel);  // first, so that the sentence's length does not move it
    drawWhy(studio, *pixel);
    if (!view.pyramid.open) drawNote(studio, *pixel);  // the pyramid is of the whole picture
    view.pyramid.open = view.differs = false;
    if (ImGui::BeginTabBar("about rays")) {
      const auto tab = [&](const char* name, void (*draw)(Studio&, const TracedPixel&)) {
        const ImGuiTabItemFlags flags = studio.raysTab == name ? ImGuiTabItemFlags_SetSelected : 0;
        if (!ImGui::BeginTabItem(name, nullptr, flags)) return;
        if (flags) studio.raysTab.clear();
        landmark("tab " + std::string(name));
        view.between = ImGui::GetCursorPosY() - belowSpace + ImGui::GetStyle().ItemSpacing.y;
        ImGui::BeginChild(name);
        draw(studio, *pixel);
        ImGui::EndChild();
        ImGui::EndTabItem();
      };
      if (view.chains.offered()) tab("Chain", drawChain);
      tab("Tree", drawTree);
      tab("Ray", drawNumbers);
      if (hasTrait(pixel->session->settings(), Trait::joinsEnds)) tab("Ways", drawWays);
      if (showsStrategies(pixel->session->settings())) tab("Pyramid", drawPyramid);
      tab("Difference", [](Studio& s, const TracedPixel& traced) {
        s.rays.differs = true;
        drawDifference(s, traced);
      });
      ImGui::EndTabBar();
    }
  }
  view.hoveredBefore = view.hovered;
}

}  // namespace trace::studio
