// The panel Picture: the render as it comes, a reference beside or over it, values under the cursor.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "app/view/picture_views.h"
#include "studio/panels.h"
#include "studio/picture/picture_parts.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr double kLeastInterval = 0.1;  // seconds between two looks at a render
constexpr double kMostShare = 0.15;     // share of the time that may go into looking
constexpr float kGap = 6;               // between two pictures side by side

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
  Settings settings = workspace.shownSettings();
  if (const auto session = workspace.render.session(); session && settings.autoExposure)
    settings.exposure += session->measuredExposure();
  const bool toneChanged = view.exposed != view.exposure || view.development != developmentOf(settings) ||
                           view.rounding != settings.rounding;
  bool pictureChanged = false;
  const double now = ImGui::GetTime(), interval = std::max(kLeastInterval, view.refreshCost / kMostShare);
  const bool due = !workspace.render.state().working() || now - view.refreshed > interval;
  if (const std::uint64_t version = workspace.render.version(); version != view.shownVersion && due) {
    view.shownVersion = version;
    view.shown = workspace.render.picture();
    pictureChanged = true;
    view.waits = workspace.document.isOpen() && view.shown.width == 0;
    if (!workspace.render.session()) view.convergence = {};
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
  const ImVec2 size{std::max(1.0f, static_cast<float>(width) * view.zoom),  // however thin, it is seen
                    std::max(1.0f, static_cast<float>(height) * view.zoom)};
  return {{std::round(canvas.x + area.x / 2 - static_cast<float>(view.centreX) * size.x),
           std::round(canvas.y + area.y / 2 - static_cast<float>(view.centreY) * size.y)},
          size};
}

void pictureIn(const FrameArea& frame, const Texture& texture) {
  ImGui::GetWindowDrawList()->AddImage(texture.id(), frame.low,
                                       {frame.low.x + frame.size.x, frame.low.y + frame.size.y});
}

/// A text on a dark plate, so that it can be read on any picture, in lines of at most that width.
void caption(ImVec2 at, const char* text, float most) {
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  const float room = std::max(most - 2 * pad.x, characters(12));
  const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, room);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + size.x + 2 * pad.x, at.y + size.y + 2 * pad.y}, IM_COL32(0, 0, 0, 170), 4);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x + pad.x, at.y + pad.y},
               IM_COL32(255, 255, 255, 255), text, nullptr, room);
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

/// The pixels where the chain that is followed was, up to its chosen move: small moves are joined.
void drawChainWay(const Studio& studio, const FrameArea& frame, int width, int height) {
  const ChainInspector& chains = studio.rays.chains;
  if (!chains.offered()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::optional<ImVec2> last;
  const float radius = 2 * studio.theme.scale;
  for (int i = 0; i <= chains.index(); ++i) {
    const ChainMove& move = chains.walk()->moves[static_cast<std::size_t>(i)];
    const ImVec2 at = frame.at((move.x + 0.5) / width, (move.y + 0.5) / height);
    if (i == chains.index()) {
      if (last) list.AddLine(*last, at, IM_COL32(255, 210, 60, 255), 1.5f);
      list.AddCircle(at, 3 * radius, IM_COL32(255, 210, 60, 255), 0, move.made ? 2.5f : 1.0f);
    }
    if (!move.made) continue;
    const bool round = last && (std::abs(at.x - last->x) > frame.size.x / 2 ||  // by the picture's other edge
                                std::abs(at.y - last->y) > frame.size.y / 2);
    if (last && move.kind != MoveKind::anywhere && !round)
      list.AddLine(*last, at, IM_COL32(110, 200, 255, 130), 1);
    list.AddCircleFilled(at, radius, IM_COL32(110, 200, 255, 200));
    last = at;
  }
}

/// One way of the pyramid, or a plane of the render.
InPlaceOfPicture inPlaceOfPicture(const Studio& studio) {
  const PictureView& view = studio.picture;
  if (InPlaceOfPicture way = wayAlone(studio); !way.caption.empty()) return way;
  if (view.plane == FilmPlane::picture || view.planeTexture.empty()) return {};
  return {&view.planeTexture, view.planeLegend};
}

/// The picture or pictures in the area; true with the pixel if the cursor is on one.
bool drawCanvas(Studio& studio, ImVec2 canvas, ImVec2 area, int& x, int& y) {
  PictureView& view = studio.picture;
  const auto& reference = studio.workspace.reference();
  const int width = view.shown.width, height = view.shown.height;
  const InPlaceOfPicture other = inPlaceOfPicture(studio);
  const View mode = reference && other.caption.empty() ? view.view : View::picture;
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
  const bool comparable = reference && sameSize(*reference, view.shown);
  const bool differs = mode == View::difference || mode == View::falseColour;
  if (mode == View::picture || (differs && !comparable))
    clipped(canvas, end, frame, other.texture ? *other.texture : view.pictureTexture);
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
  if (!other.caption.empty()) {
    caption(corner, other.caption.c_str(), area.x - 16);
    landmark("caption");
  } else if (mode != View::picture && !comparable) {
    caption(corner,
            ("the reference has another size: " + std::to_string(reference->width) + " x " +
             std::to_string(reference->height) + " beside " + std::to_string(width) + " x " +
             std::to_string(height))
                .c_str(),
            area.x - 16);
  } else if (two || mode == View::swipe) {
    caption(corner, "picture", area.x);
    const float wide = ImGui::CalcTextSize("reference").x + 2 * ImGui::GetStyle().FramePadding.x;
    caption({end.x - wide - 8, corner.y}, "reference", area.x);
  } else if (mode != View::picture) {
    caption(corner, kViewNames[static_cast<int>(mode)], area.x);
  }

  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const FrameArea& under = two && mouse.x > canvas.x + part.x ? second : frame;
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) zoomAndPan(view, under);
  // -1 before the first. A mouse outside the window may be anywhere.
  const auto pixelAt = [](float share, int size) {
    const float most = static_cast<float>(size);
    return static_cast<int>(std::floor(std::clamp(share * most, -1.0f, most)));
  };
  x = pixelAt((mouse.x - under.low.x) / under.size.x, width);
  y = pixelAt((mouse.y - under.low.y) / under.size.y, height);
  const bool inside = ImGui::IsItemHovered() && x >= 0 && y >= 0 && x < width && y < height;

  if (!other.texture && mode == View::picture) {
    list.PushClipRect(canvas, end, true);
    drawChainWay(studio, frame, width, height);
    list.PopClipRect();
  }
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

/// The picture, in which a click chooses a pixel; true with the pixel if the cursor is on one.
bool drawClickable(Studio& studio, ImVec2 canvas, ImVec2 area, int& x, int& y) {
  PictureView& view = studio.picture;
  ImGui::InvisibleButton("canvas", area,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  landmark("picture");
  const bool inside = drawCanvas(studio, canvas, area, x, y);
  const bool swiping = studio.workspace.reference() && view.view == View::swipe;
  if (inside && (swiping ? ImGui::IsItemClicked(0) : ImGui::IsItemActive() && ImGui::IsMouseDown(0)))
    view.pixel.choose(x, y, {view.shown.width, view.shown.height});
  return inside;
}

}  // namespace

void drawPictureAlone(Studio& studio) {
  refresh(studio);
  const ImVec2 area = ImGui::GetContentRegionAvail();
  if (area.x < 8 || area.y < 8 || studio.picture.pictureTexture.empty() || studio.picture.waits) return;
  int x = 0, y = 0;
  drawClickable(studio, ImGui::GetCursorScreenPos(), area, x, y);
}

void drawPicture(Studio& studio) {
  refresh(studio);
  if (!studio.workspace.document.isOpen()) return drawStart(studio, ImGui::GetContentRegionAvail());
  drawBar(studio);
  const ImVec2 canvas = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const float below = ImGui::GetFrameHeightWithSpacing() + ImGui::GetFrameHeightWithSpacing() +
                      (studio.workspace.reference() ? ImGui::GetTextLineHeightWithSpacing() : 0);
  const ImVec2 area{room.x, room.y - below};
  if (area.x < 8 || area.y < 8) return;
  PictureView& view = studio.picture;
  if (view.pictureTexture.empty() || view.waits) {
    ImGui::Dummy(area);
    return drawStatus(studio, false, 0, 0);
  }
  int x = 0, y = 0;
  const bool inside = drawClickable(studio, canvas, area, x, y);
  drawStatus(studio, inside, x, y);
}

}  // namespace trace::studio
