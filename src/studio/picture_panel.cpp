// The panel Picture: the render as it comes, a reference beside or over it, values under the cursor.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/picture_views.h"
#include "studio/actions.h"
#include "studio/landmarks.h"
#include "studio/panels.h"

namespace trace::studio {
namespace {

constexpr double kLeastInterval = 0.1;  // seconds between two looks at a render
constexpr double kMostShare = 0.15;     // of the time may go into looking
constexpr float kGap = 6;               // between two pictures side by side

bool sameSize(const Picture& a, const Picture& b) { return a.width == b.width && a.height == b.height; }

/// How far the render has come, and the plane that is looked at.
void refreshPlane(Studio& studio, bool pictureChanged) {
  PictureView& view = studio.picture;
  const auto session = studio.workspace.render.session();
  if (!session || (!pictureChanged && view.planeShown == view.plane)) return;
  const Film& film = session->film();
  if (pictureChanged) {
    const std::uint64_t number = studio.workspace.render.state().number;
    if (number != view.noiseOf) view.noise.clear();
    view.noiseOf = number;
    view.convergence = film.convergence();
    if (view.convergence.judged) view.noise.push_back(static_cast<float>(255 * view.convergence.error));
  }
  view.planeShown = view.plane;
  if (view.plane == FilmPlane::picture || film.width() != view.shown.width ||
      film.height() != view.shown.height)
    return;
  const PlaneView plane = planeView(view.plane, film, view.shown);
  view.planeTexture.set(toBytes(plane.colours, Rounding::nearest));
  view.planeLegend = plane.legend;
}

/// Brings the textures up to date.
void refresh(Studio& studio) {
  PictureView& view = studio.picture;
  Workspace& workspace = studio.workspace;
  const Settings settings = workspace.document.isOpen() ? workspace.document.settings() : Settings{};
  const bool toneChanged = view.exposed != view.exposure || view.development != developmentOf(settings) ||
                           view.rounding != settings.rounding;
  bool pictureChanged = false;
  const double now = ImGui::GetTime(), interval = std::max(kLeastInterval, view.refreshCost / kMostShare);
  const bool due = !workspace.render.state().working() || now - view.refreshed > interval;
  if (const std::uint64_t version = workspace.render.version(); version != view.shownVersion && due) {
    view.shownVersion = version;
    view.shown = workspace.render.picture();
    pictureChanged = true;
  }
  if (pictureChanged || view.development != developmentOf(settings))
    view.levels = developed(view.shown, developmentOf(settings));
  if (view.shown.width > 0 && (pictureChanged || toneChanged))
    view.pictureTexture.set(exposed(view.levels, view.exposure, settings.rounding));
  refreshPlane(studio, pictureChanged);
  const auto& reference = workspace.reference();
  const bool referenceChanged = view.referenceVersion != workspace.referenceVersion();
  if (reference && referenceChanged) view.view = View::swipe;
  if (reference && (referenceChanged || toneChanged))
    view.referenceTexture.set(exposed(*reference, view.exposure, settings.rounding));
  const bool compares = view.view == View::difference || view.view == View::falseColour;
  if (compares && reference && sameSize(view.shown, *reference) &&
      (pictureChanged || toneChanged || referenceChanged || view.differenceView != view.view ||
       view.differenceMagnify != view.magnify)) {
    const bool colours = view.view == View::falseColour;
    const Picture picture = workspace.referenceIsLinear() ? view.shown : clamped(view.levels);
    const Picture difference = colours ? falseColours(picture, *reference, view.magnify)
                                       : differences(picture, *reference, view.magnify);
    view.differenceTexture.set(toBytes(difference, Rounding::nearest));
    view.differenceView = view.view;
    view.differenceMagnify = view.magnify;
  }
  view.referenceVersion = workspace.referenceVersion();
  view.exposed = view.exposure;
  view.development = developmentOf(settings);
  view.rounding = settings.rounding;
  if (pictureChanged) {
    view.refreshed = now;
    view.refreshCost = 0;
  }
}

void drawBar(Studio& studio) {
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
  if (working && button(" Stop ", "stop; what is done stays (Esc)", true)) studio.workspace.render.stop();
  const auto runAction = [&](const char* name) {
    for (const Action& action : actions())
      if (std::string_view(action.name) == name) action.run(studio);
  };
  if (button("Export...", "write the picture to a file (Ctrl+E)", !view.pictureTexture.empty()))
    runAction("Export picture...");
  if (button("Fit", "the whole picture (F)", true)) view.fit = true;
  if (button("1:1", "one pixel to one of the screen (A)", true)) {
    view.fit = false;
    view.zoom = 1;
  }

  const auto roomFor = [](float wide) {  // else on the next line
    if (ImGui::GetContentRegionAvail().x < wide) ImGui::NewLine();
  };
  roomFor(characters(17));
  ImGui::SetNextItemWidth(characters(17));
  ImGui::SliderFloat("##exposure", &view.exposure, -6, 6,
                     view.exposure == 0 ? "exposure 0" : "exposure %+.1f");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("stops: powers of two; only what is shown, not what is saved\nright click: 0");
  if (ImGui::IsItemClicked(1)) view.exposure = 0;
  ImGui::SameLine();
  roomFor(characters(17));
  ImGui::SetNextItemWidth(characters(17));
  int plane = static_cast<int>(view.plane);
  if (ImGui::Combo("##plane", &plane, kPlaneNames, static_cast<int>(std::size(kPlaneNames))))
    view.plane = static_cast<FilmPlane>(plane);
  landmark("plane");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "the picture, how many rays each pixel has, how much noise is left in it, or what denoise "
        "changed");
  if (!studio.workspace.reference()) {
    ImGui::SameLine();
    roomFor(ImGui::CalcTextSize("Compare...").x + 2 * ImGui::GetStyle().FramePadding.x);
    if (ImGui::Button("Compare...")) runAction("Open reference...");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("choose a picture to compare with (Ctrl+Shift+R)");
    return;
  }
  int index = static_cast<int>(view.view);
  ImGui::SetNextItemWidth(characters(20));
  if (ImGui::Combo("##view", &index, kViewNames, static_cast<int>(std::size(kViewNames))))
    view.view = static_cast<View>(index);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("how the two pictures are shown (C)");
  if (view.view == View::difference || view.view == View::falseColour) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(characters(14));
    ImGui::SliderFloat("##magnify", &view.magnify, 1, 255, "x %.0f", ImGuiSliderFlags_Logarithmic);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("by which differences are magnified");
  }
}

/// Where one picture lies on the screen.
struct FrameArea {
  ImVec2 low, size;
  ImVec2 at(double x, double y) const {
    return {low.x + static_cast<float>(x) * size.x, low.y + static_cast<float>(y) * size.y};
  }
};

FrameArea frameOf(PictureView& view, ImVec2 canvas, ImVec2 area, int width, int height) {
  if (view.fit) {
    view.zoom = std::min(area.x / static_cast<float>(width), area.y / static_cast<float>(height));
    view.centreX = view.centreY = 0.5;
  }
  const ImVec2 size{static_cast<float>(width) * view.zoom, static_cast<float>(height) * view.zoom};
  return {{std::round(canvas.x + area.x / 2 - static_cast<float>(view.centreX) * size.x),
           std::round(canvas.y + area.y / 2 - static_cast<float>(view.centreY) * size.y)},
          size};
}

void pictureIn(const FrameArea& frame, const Texture& texture) {
  ImGui::GetWindowDrawList()->AddImage(texture.id(), frame.low,
                                       {frame.low.x + frame.size.x, frame.low.y + frame.size.y});
}

/// A text on a dark plate, so that it can be read on any picture.
void caption(ImVec2 at, const char* text) {
  const ImVec2 size = ImGui::CalcTextSize(text), pad = ImGui::GetStyle().FramePadding;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + size.x + 2 * pad.x, at.y + size.y + 2 * pad.y}, IM_COL32(0, 0, 0, 170), 4);
  list.AddText({at.x + pad.x, at.y + pad.y}, IM_COL32(255, 255, 255, 255), text);
}

void zoomAndPan(PictureView& view, const FrameArea& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0) {
    const double x = (io.MousePos.x - frame.low.x) / frame.size.x,
                 y = (io.MousePos.y - frame.low.y) / frame.size.y;
    const float before = view.zoom;
    view.zoom = std::clamp(view.zoom * std::pow(1.25f, io.MouseWheel), 0.02f, 128.0f);
    const double keep = before / view.zoom;  // the place under the cursor stays there
    view.centreX = x + (view.centreX - x) * keep;
    view.centreY = y + (view.centreY - y) * keep;
    view.fit = false;
  }
  if (ImGui::IsMouseDragging(1, 0) || ImGui::IsMouseDragging(2, 0)) {
    view.centreX -= io.MouseDelta.x / frame.size.x;
    view.centreY -= io.MouseDelta.y / frame.size.y;
    if (io.MouseDelta.x != 0 || io.MouseDelta.y != 0) view.fit = false;
  }
}

void drawStatus(Studio& studio, bool hovered, int x, int y) {
  const PictureView& view = studio.picture;
  Workspace& workspace = studio.workspace;
  const BackgroundRender::State state = workspace.render.state();
  if (state.working()) {
    char text[96];
    const std::string left = state.remaining ? ", " + durationText(*state.remaining) + " left" : "";
    if (state.phase == BackgroundRender::Phase::building)
      std::snprintf(text, sizeof text, "building");
    else if (state.phase == BackgroundRender::Phase::denoising)
      std::snprintf(text, sizeof text, "taking noise out");
    else
      std::snprintf(text, sizeof text, "%.0f %%, %s%s", std::floor(100 * state.fraction),
                    durationText(state.elapsed).c_str(), left.c_str());
    ImGui::ProgressBar(static_cast<float>(state.fraction), {characters(28), ImGui::GetFrameHeight()}, text);
    ImGui::SameLine();
  }
  if (!hovered && view.noise.size() > 1) {  // how noise falls
    const float most = *std::max_element(view.noise.begin(), view.noise.end());
    ImGui::PlotLines("##noise", view.noise.data(), static_cast<int>(view.noise.size()), 0, nullptr, 0, most,
                     {characters(12), ImGui::GetFrameHeight()});
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip(
          "the noise of the picture since the render began: the standard error of a pixel's mean, on "
          "the average, in levels of 255; at the top %.3g",
          most);
    ImGui::SameLine();
  }
  ImGui::AlignTextToFramePadding();
  if (hovered) {
    ImGui::Text("%d, %d", x, y);
    const Color c = view.levels.at(x, y);
    const Rounding rounding = workspace.document.settings().rounding;
    ImGui::SameLine(0, characters(3));
    const Color clamped = clamp01(c);
    const float side = ImGui::GetFontSize();
    ImGui::ColorButton(
        "##colour",
        {static_cast<float>(clamped.r), static_cast<float>(clamped.g), static_cast<float>(clamped.b), 1},
        ImGuiColorEditFlags_NoTooltip, {side, side});
    ImGui::SameLine();
    ImGui::TextUnformatted(pixelText(view.shown.at(x, y), c, rounding).c_str());
    const auto& reference = workspace.reference();
    if (reference && sameSize(*reference, view.shown)) {
      ImGui::TextDisabled("reference  %s",
                          pixelText(reference->at(x, y), reference->at(x, y), rounding).c_str());
    }
  } else if (workspace.saving() || workspace.reading()) {
    ImGui::TextDisabled(workspace.saving() ? "writing the file" : "reading the file");
  } else if (state.working()) {
    ImGui::TextDisabled("%s", view.convergence.samples > 0 ? convergenceText(view.convergence).c_str() : " ");
  } else if (view.shown.width > 0) {
    const char* how = state.phase == BackgroundRender::Phase::finished ? "finished"
                      : state.phase == BackgroundRender::Phase::failed ? "failed: see the log"
                                                                       : "stopped";
    const bool several = view.convergence.samples > 1;
    ImGui::TextDisabled("%d x %d, %s after %s%s%s%s", view.shown.width, view.shown.height, how,
                        durationText(state.elapsed).c_str(), several ? ", " : "",
                        several ? convergenceText(view.convergence).c_str() : "",
                        workspace.stale() ? "; the scene has changed since: F5 renders" : "");
  } else {
    ImGui::TextUnformatted(" ");
  }
}

void drawWelcome(Studio& studio, ImVec2 area) {
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + area.y * 0.3f);
  const auto centred = [&](const char* text) {
    ImGui::SetCursorPosX(std::max(0.0f, (area.x - ImGui::CalcTextSize(text).x) / 2));
    ImGui::TextDisabled("%s", text);
  };
  centred(studio.workspace.reading() ? "The file is being read." : "Drop a scene here, or");
  ImGui::SetCursorPosX(std::max(0.0f, (area.x - characters(24)) / 2));
  if (ImGui::Button("Open scene...", {characters(24), 0})) actions().front().run(studio);
  const auto recent = studio.workspace.recent();
  if (!recent.empty()) {
    ImGui::NewLine();
    centred("Opened lately:");
  }
  for (const std::string& file : recent) {
    ImGui::SetCursorPosX(std::max(0.0f, (area.x - ImGui::CalcTextSize(file.c_str()).x) / 2));
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    if (ImGui::SmallButton(file.c_str())) studio.workspace.open(file);
    ImGui::PopStyleColor();
  }
}

/// The picture or pictures in the area; true with the pixel if the cursor is on one.
bool drawCanvas(Studio& studio, ImVec2 canvas, ImVec2 area, int& x, int& y) {
  PictureView& view = studio.picture;
  const auto& reference = studio.workspace.reference();
  const int width = view.shown.width, height = view.shown.height;
  const bool ofPlane = view.plane != FilmPlane::picture && !view.planeTexture.empty();
  const View mode = reference && !ofPlane ? view.view : View::picture;
  const bool two = mode == View::sideBySide;
  const ImVec2 part{two ? std::max(1.0f, (area.x - kGap) / 2) : area.x, area.y};
  const FrameArea frame = frameOf(view, canvas, part, width, height);
  const FrameArea second{{frame.low.x + part.x + kGap, frame.low.y}, frame.size};
  ImDrawList& list = *ImGui::GetWindowDrawList();

  const auto clipped = [&](ImVec2 low, ImVec2 high, const FrameArea& at, const Texture& texture) {
    list.PushClipRect(low, high, true);
    pictureIn(at, texture);
    list.PopClipRect();
  };
  const ImVec2 end{canvas.x + area.x, canvas.y + area.y};
  if (ofPlane) {
    clipped(canvas, end, frame, view.planeTexture);
    caption({canvas.x + 8, canvas.y + 8}, view.planeLegend.c_str());
  }
  const bool comparable = reference && sameSize(*reference, view.shown);
  const bool differs = mode == View::difference || mode == View::falseColour;
  if (!ofPlane && (mode == View::picture || (differs && !comparable)))
    clipped(canvas, end, frame, view.pictureTexture);
  if (mode == View::reference) clipped(canvas, end, frame, view.referenceTexture);
  if (two) {
    clipped(canvas, {canvas.x + part.x, end.y}, frame, view.pictureTexture);
    clipped({canvas.x + part.x + kGap, canvas.y}, end, second, view.referenceTexture);
  }
  if (mode == View::swipe) {
    const float left = std::max(frame.low.x, canvas.x), right = std::min(frame.low.x + frame.size.x, end.x);
    const float line = std::round(left + (right - left) * view.swipe);
    clipped(canvas, {line, end.y}, frame, view.pictureTexture);
    clipped({line, canvas.y}, end, frame, view.referenceTexture);
    list.AddLine({line, canvas.y}, {line, end.y}, ImGui::GetColorU32(studio.palette().accent), 2);
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0) && right > left)
      view.swipe = std::clamp((ImGui::GetIO().MousePos.x - left) / (right - left), 0.0f, 1.0f);
  }
  if (differs && comparable) clipped(canvas, end, frame, view.differenceTexture);
  const ImVec2 corner{canvas.x + 8, canvas.y + 8};
  if (mode != View::picture && !comparable)
    caption(corner, "the reference has another size");
  else if (two || mode == View::swipe) {
    caption(corner, "picture");
    const float wide = ImGui::CalcTextSize("reference").x + 2 * ImGui::GetStyle().FramePadding.x;
    caption({end.x - wide - 8, corner.y}, "reference");
  } else if (mode != View::picture) {
    caption(corner, kViewNames[static_cast<int>(mode)]);
  }

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const FrameArea& under = two && mouse.x > canvas.x + part.x ? second : frame;
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) zoomAndPan(view, under);
  x = static_cast<int>(std::floor((mouse.x - under.low.x) / under.size.x * static_cast<float>(width)));
  y = static_cast<int>(std::floor((mouse.y - under.low.y) / under.size.y * static_cast<float>(height)));
  const bool inside = ImGui::IsItemHovered() && x >= 0 && y >= 0 && x < width && y < height;

  const PixelPlace pixel = view.pixel ? view.pixel.in({width, height}) : PixelPlace{};
  if (view.pixel && pixel.x < width && pixel.y < height) {
    const float side = std::max(view.zoom, 1.0f), ring = std::max(side, 9.0f * studio.theme.scale);
    const ImVec2 middle = frame.at((pixel.x + 0.5) / width, (pixel.y + 0.5) / height);
    list.PushClipRect(canvas, end, true);
    const ImVec2 low{middle.x - ring / 2, middle.y - ring / 2},
        high{middle.x + ring / 2, middle.y + ring / 2};
    list.AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, IM_COL32(0, 0, 0, 200), 0, 0, 3);
    list.AddRect(low, high, IM_COL32(255, 210, 60, 255), 0, 0, 1.5f);
    list.PopClipRect();
  }
  return inside;
}

}  // namespace

void drawPicture(Studio& studio) {
  refresh(studio);
  drawBar(studio);
  const ImVec2 canvas = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const float below = ImGui::GetFrameHeightWithSpacing() +
                      (studio.workspace.reference() ? ImGui::GetTextLineHeightWithSpacing() : 0);
  const ImVec2 area{room.x, room.y - below};
  if (area.x < 8 || area.y < 8) return;
  PictureView& view = studio.picture;
  if (view.pictureTexture.empty()) {
    if (!studio.workspace.document.isOpen()) return drawWelcome(studio, area);
    ImGui::Dummy(area);
    return drawStatus(studio, false, 0, 0);
  }
  ImGui::InvisibleButton("canvas", area,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  landmark("picture");
  int x = 0, y = 0;
  const bool inside = drawCanvas(studio, canvas, area, x, y);
  const bool swiping = studio.workspace.reference() && view.view == View::swipe;
  if (inside && (swiping ? ImGui::IsItemClicked(0) : ImGui::IsItemActive() && ImGui::IsMouseDown(0)))
    view.pixel.choose(x, y, {view.shown.width, view.shown.height});
  drawStatus(studio, inside, x, y);
}

}  // namespace trace::studio
