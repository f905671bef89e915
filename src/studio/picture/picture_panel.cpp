// The panel Picture: the render as it comes, a reference beside or over it, values under the cursor.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include "app/view/picture_views.h"
#include "app/view/screen/overlays.h"
#include "image/comparison/false_color.h"
#include "math/elementary.h"
#include "studio/panels.h"
#include "studio/picture/picture_parts.h"
#include "studio/widgets/drag.h"
#include "studio/widgets/field_editor.h"
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
  const bool showsCost = view.plane == FilmPlane::cost && view.pass.empty();
  view.cost.want(showsCost ? session : nullptr);
  const bool costChanged = view.cost.update();
  const std::vector<std::string_view> passes =
      session ? passesToSee(session->settings()) : std::vector<std::string_view>{};
  if (std::find(passes.begin(), passes.end(), view.pass) == passes.end()) view.pass.clear();
  if (!session ||
      (!pictureChanged && !costChanged && view.planeShown == view.plane && view.passShown == view.pass))
    return;
  const Film& film = session->film();
  if (pictureChanged) {
    const std::uint64_t number = studio.workspace.render.state().number;
    if (number != view.noiseOf) view.noise.clear();
    view.noiseOf = number;
    view.convergence = film.convergence();
    if (view.convergence.judged) view.noise.push_back(static_cast<float>(255 * view.convergence.error));
  }
  view.planeShown = view.plane;
  view.passShown = view.pass;
  if (!view.showsPlane() || film.width() != view.shown.width || film.height() != view.shown.height) return;
  view.planeMade = view.pass.empty()
                       ? planeView(view.plane, film, view.shown, view.cost.map())
                       : passView(view.pass, film, session->settings(), session->names(), view.shown);
  view.planeTexture.set(toBytes(view.planeMade.colours, Rounding::nearest));
}

double histogramEnd(const PictureView& view, View of) {
  return of == View::difference ? 1 / static_cast<double>(view.magnify) : 1;
}

Picture magnified(Picture picture, double factor) {
  for (Color& c : picture.pixels) c = c * factor;
  return picture;
}

/// Brings the textures up to date.
void refresh(Studio& studio) {
  PictureView& view = studio.picture;
  Workspace& workspace = studio.workspace;
  const Settings settings = workspace.withExposureMeasured(workspace.shownSettings());
  const bool toneChanged = view.exposed != view.exposure || view.development != developmentOf(settings) ||
                           view.rounding != settings.rounding || view.channelShown != view.channel;
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
  if (view.shown.width > 0 && (pictureChanged || toneChanged)) {
    view.pictureTexture.set(exposed(channelOf(view.levels, view.channel), view.exposure, settings.rounding));
  }
  refreshPlane(studio, pictureChanged);
  const auto& reference = workspace.reference();
  const bool referenceChanged = view.referenceVersion != workspace.referenceVersion();
  if (reference && referenceChanged) view.view = View::swipe;
  if (reference && (referenceChanged || toneChanged))
    view.referenceTexture.set(exposed(channelOf(*reference, view.channel), view.exposure, settings.rounding));
  if (!reference) view.reference = {};
  if (reference && view.shown.width > 0 && (referenceChanged || !sameSize(view.reference, view.shown)))
    view.reference = sameSize(*reference, view.shown)
                         ? *reference
                         : resampled(*reference, view.shown.width, view.shown.height);
  const bool compares = view.view == View::difference || view.view == View::falseColour;
  if (compares && reference && sameSize(view.shown, view.reference) &&
      (pictureChanged || toneChanged || referenceChanged || view.differenceView != view.view ||
       view.differenceMagnify != view.magnify || view.differenceChosen != view.magnifyChosen)) {
    const bool colours = view.view == View::falseColour;
    Picture picture = workspace.referenceIsLinear() ? view.shown : clamped(view.levels);
    if (!workspace.referenceIsLinear() && holdsLevels(view.reference))  // as its own file would have it
      picture = roundedToLevels(std::move(picture), settings.rounding);
    const Picture seen = channelOf(picture, view.channel), other = channelOf(view.reference, view.channel);
    view.difference = differences(seen, other, 1);
    if (!view.magnifyChosen) view.magnify = static_cast<float>(magnificationFor(view.difference));
    const Picture difference =
        colours ? falseColours(seen, other, view.magnify) : magnified(view.difference, view.magnify);
    view.errors = differenceText(seen, other);
    if (!sameSize(*reference, view.shown))
      view.errors += "; the reference was resampled from " + std::to_string(reference->width) + " x " +
                     std::to_string(reference->height);
    view.differenceTexture.set(toBytes(difference, Rounding::nearest));
    view.differenceView = view.view;
    view.differenceMagnify = view.magnify;
    view.differenceChosen = view.magnifyChosen;
  }
  const View histogramView = reference ? view.view : View::picture;
  if (view.shown.width > 0 && hasHistogram(histogramView) &&
      (pictureChanged || toneChanged || referenceChanged || view.histogramView != histogramView ||
       view.histogramEnd != histogramEnd(view, histogramView))) {
    view.histogramView = histogramView;
    view.histogramEnd = histogramEnd(view, histogramView);
    view.histogram = histogramOf(histogramView == View::difference  ? magnified(view.difference, view.magnify)
                                 : histogramView == View::reference ? channelOf(*reference, view.channel)
                                                                    : channelOf(view.levels, view.channel));
  }
  view.referenceVersion = workspace.referenceVersion();
  view.exposed = view.exposure;
  view.channelShown = view.channel;
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

/// `whole` and `room`: the panel, in which a picture that is enlarged stays when captions and scales come.
FrameArea frameOf(PictureView& view, ImVec2 whole, ImVec2 room, ImVec2 canvas, ImVec2 area, int width,
                  int height) {
  if (view.fit) {
    view.zoom = std::min(area.x / static_cast<float>(width), area.y / static_cast<float>(height));
    view.centreX = view.centreY = 0.5;
  } else {
    canvas = whole;
    area = room;
  }
  const ImVec2 size{std::max(1.0f, static_cast<float>(width) * view.zoom),  // however thin, it is seen
                    std::max(1.0f, static_cast<float>(height) * view.zoom)};
  return {{std::round(canvas.x + area.x / 2 - static_cast<float>(view.centreX) * size.x),
           std::round(canvas.y + area.y / 2 - static_cast<float>(view.centreY) * size.y)},
          size};
}

/// The largest area of that shape in the middle of another.
FrameArea inside(const FrameArea& frame, int width, int height) {
  const float zoom =
      std::min(frame.size.x / static_cast<float>(width), frame.size.y / static_cast<float>(height));
  const ImVec2 size{static_cast<float>(width) * zoom, static_cast<float>(height) * zoom};
  return {{frame.low.x + (frame.size.x - size.x) / 2, frame.low.y + (frame.size.y - size.y) / 2}, size};
}

void pictureIn(const FrameArea& frame, const Texture& texture) {
  ImGui::GetWindowDrawList()->AddImage(texture.id(), frame.low,
                                       {frame.low.x + frame.size.x, frame.low.y + frame.size.y});
}

/// A text on a dark plate, so that it can be read on any picture, in lines of at most that width. Where it
/// ends.
float caption(ImVec2 at, const char* text, float most) {
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  const std::string lines = inLines(text, std::max(most - 2 * pad.x, characters(12)));
  const ImVec2 size = ImGui::CalcTextSize(lines.c_str());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + size.x + 2 * pad.x, at.y + size.y + 2 * pad.y}, IM_COL32(0, 0, 0, 170), 4);
  list.AddText({at.x + pad.x, at.y + pad.y}, IM_COL32(255, 255, 255, 255), lines.c_str());
  return at.y + size.y + 2 * pad.y;
}

/// The values of each pixel in it, of so many channels, where the picture is magnified so much that they have
/// room.
void numbersInPixels(const Studio& studio, const FrameArea& frame, ImVec2 low, ImVec2 high,
                     const Picture& picture, int channels = 3) {
  const float line = ImGui::GetTextLineHeight(), zoom = studio.picture.zoom;
  const float half = static_cast<float>(channels) / 2;  // half the number of lines
  const ImVec2 digits = ImGui::CalcTextSize("0.000");
  if (zoom < digits.x + 6 || zoom < 3 * line + 4 || picture.width == 0) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(low, high, true);
  const auto first = [&](float from, float corner) {
    return std::max(0, static_cast<int>((from - corner) / zoom));
  };
  const auto last = [&](float to, float corner, int size) {
    return std::min(size - 1, static_cast<int>((to - corner) / zoom));
  };
  constexpr ImU32 kColours[] = {IM_COL32(255, 130, 130, 255), IM_COL32(140, 235, 140, 255),
                                IM_COL32(150, 180, 255, 255)};
  for (int y = first(low.y, frame.low.y); y <= last(high.y, frame.low.y, picture.height); ++y)
    for (int x = first(low.x, frame.low.x); x <= last(high.x, frame.low.x, picture.width); ++x) {
      const Color& c = picture.at(x, y);
      const double values[] = {c.r, c.g, c.b};
      const ImVec2 middle = frame.at((x + 0.5) / picture.width, (y + 0.5) / picture.height);
      list.AddRectFilled({middle.x - digits.x / 2 - 3, middle.y - half * line - 2},
                         {middle.x + digits.x / 2 + 3, middle.y + half * line + 2}, IM_COL32(0, 0, 0, 150),
                         3);
      for (int i = 0; i < channels; ++i) {
        char text[16];
        const bool small = std::abs(values[i]) < 100;
        std::snprintf(text, sizeof text, channels == 1 ? "%.4g" : small ? "%.3f" : "%.3g", values[i]);
        const float wide = ImGui::CalcTextSize(text).x;
        list.AddText({middle.x - wide / 2, middle.y + (static_cast<float>(i) - half) * line},
                     channels == 1 ? IM_COL32_WHITE : kColours[i], text);
      }
    }
  list.PopClipRect();
}

constexpr int kSteps = 5, kBands = 30;  // numbers and bands of a scale

constexpr float kNowhere = 1e9f;

/// The room that scales take.
float uprightScale() {
  return ImGui::GetTextLineHeight() + 4 * ImGui::GetStyle().FramePadding.x +
         ImGui::CalcTextSize("> 0.00000").x + 8;
}
float flatScale(float across) {
  const bool fits = across > (kSteps + 3) * ImGui::CalcTextSize("> 0.00000").x;
  return fits ? 2.5f * ImGui::GetTextLineHeight() + 8 : kNowhere;
}

ImU32 bandColour(Color (*colourAt)(double), int band) {
  const Color c = colourAt(band / double{kBands});
  return ImGui::GetColorU32(
      ImVec4(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1));
}

std::string scaleNumber(const ColourScale& scale, int step) {
  const std::string number =
      ColourScale{scale.white, scale.logarithmic}.text(scale.valueAt(step / double{kSteps}));
  return (step == kSteps && scale.andMore ? "> " : "") + number;
}

/// The scale of false colours, which `colourAt` gives for places from 0 to 1, at the right edge.
void drawScale(ImVec2 low, ImVec2 high, const ColourScale& scale, Color (*colourAt)(double)) {
  const float line = ImGui::GetTextLineHeight(), bar = line, pad = ImGui::GetStyle().FramePadding.x;
  const float wide = bar + 3 * pad + ImGui::CalcTextSize("> 0.00000").x,
              top = std::max(low.y + 2.5f * line, (low.y + high.y) / 2 - 6 * line),
              bottom = std::min(high.y - 2 * line, top + 12 * line);
  if (bottom < top + kSteps * line) return;
  const ImVec2 at{high.x - wide - 8, top};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float head = scale.unit.empty() ? line : 2 * line;
  list.AddRectFilled({at.x - pad, top - head}, {high.x - 8, bottom + line}, IM_COL32(0, 0, 0, 170), 4);
  const auto height = [&](int part, int parts) {
    return bottom - (bottom - top) * static_cast<float>(part) / static_cast<float>(parts);
  };
  for (int band = 0; band < kBands; ++band) {
    const ImU32 below = bandColour(colourAt, band), above = bandColour(colourAt, band + 1);
    list.AddRectFilledMultiColor({at.x, height(band + 1, kBands)}, {at.x + bar, height(band, kBands)}, above,
                                 above, below, below);
  }
  for (int step = 0; step <= kSteps; ++step)
    list.AddText({at.x + bar + pad, height(step, kSteps) - line / 2}, IM_COL32_WHITE,
                 scaleNumber(scale, step).c_str());
  if (!scale.unit.empty())
    list.AddText({at.x, top - 1.75f * line}, IM_COL32_WHITE, std::string(scale.unit).c_str());
}

/// A scale from left to right, below a picture that begins and ends there.
void drawFlatScale(float left, float right, float top, const ColourScale& scale, Color (*colourAt)(double)) {
  const float line = ImGui::GetTextLineHeight(), pad = ImGui::GetStyle().FramePadding.x;
  const std::string unit(scale.unit);
  const float head = unit.empty() ? 0 : ImGui::CalcTextSize(unit.c_str()).x + 2 * pad;
  const float number = ImGui::CalcTextSize("> 0.00000").x,
              wide = std::min(right - left - head - number - 2 * pad, 12 * number);
  if (wide < kSteps * number) return;
  const ImVec2 at{std::round((left + right - wide + head) / 2), top + 8};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({at.x - head - number / 2 - pad, at.y - 4},
                     {at.x + wide + number / 2 + pad, at.y + 2.5f * line}, IM_COL32(0, 0, 0, 170), 4);
  const auto across = [&](int part, int parts) {
    return at.x + wide * static_cast<float>(part) / static_cast<float>(parts);
  };
  for (int band = 0; band < kBands; ++band) {
    const ImU32 before = bandColour(colourAt, band), after = bandColour(colourAt, band + 1);
    list.AddRectFilledMultiColor({across(band, kBands), at.y}, {across(band + 1, kBands), at.y + line},
                                 before, after, after, before);
  }
  for (int step = 0; step <= kSteps; ++step) {
    const std::string text = scaleNumber(scale, step);
    list.AddText({across(step, kSteps) - ImGui::CalcTextSize(text.c_str()).x / 2, at.y + 1.25f * line},
                 IM_COL32_WHITE, text.c_str());
  }
  if (!unit.empty()) list.AddText({at.x - head, at.y}, IM_COL32_WHITE, unit.c_str());
}

/// The height that a histogram takes below the picture.
float histogramHeight(float room) { return std::min(6 * ImGui::GetTextLineHeight(), room * 0.3f); }

/// The levels of what is seen: heights are logarithms of the counts, and the ends stand below them.
void drawHistogram(const Studio& studio, ImVec2 low, ImVec2 high) {
  const Histogram& histogram = studio.picture.histogram;
  const float text = ImGui::GetTextLineHeight();
  const ImVec2 size{std::min(characters(60), high.x - low.x - 16), high.y - low.y - text};
  if (size.x < 40 || size.y < 20 || histogram.most == 0) return;
  const ImVec2 corner{std::round((low.x + high.x - size.x) / 2), low.y};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + size.x, high.y}, IM_COL32(0, 0, 0, 190), 4);
  constexpr ImU32 kColours[] = {IM_COL32(255, 90, 90, 255), IM_COL32(90, 220, 90, 255),
                                IM_COL32(110, 150, 255, 255)};
  const auto most = static_cast<float>(math::log1p(histogram.most));
  const bool grey = studio.picture.channel != ShownChannel::all;
  for (std::size_t channel = 0; channel < (grey ? 1 : 3); ++channel) {
    ImVec2 line[Histogram::kBins];
    for (std::size_t bin = 0; bin < Histogram::kBins; ++bin) {
      const float share =
          std::min(1.0f, static_cast<float>(math::log1p(histogram.counts[channel][bin])) / most);
      line[bin] = {corner.x + 4 + (size.x - 8) * static_cast<float>(bin) / (Histogram::kBins - 1),
                   corner.y + size.y - 4 - (size.y - 8) * share};
    }
    list.AddPolyline(line, Histogram::kBins, grey ? IM_COL32_WHITE : kColours[channel], 0, 1.5f);
  }
  char end[16];
  std::snprintf(end, sizeof end, "%.3g", studio.picture.histogramEnd);
  constexpr ImU32 kQuiet = IM_COL32(255, 255, 255, 160);
  list.AddText({corner.x + 4, high.y - text}, kQuiet, "0");
  list.AddText({corner.x + size.x - 4 - ImGui::CalcTextSize(end).x, high.y - text}, kQuiet, end);
}

void zoomAndPan(PictureView& view, const FrameArea& frame) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0) {
    const double x = (io.MousePos.x - frame.low.x) / frame.size.x,
                 y = (io.MousePos.y - frame.low.y) / frame.size.y;
    const float before = view.zoom;
    view.zoom = std::clamp(view.zoom * static_cast<float>(math::pow(1.25, io.MouseWheel)), 0.02f, 128.0f);
    const double keep = before / view.zoom;  // the place under the cursor stays there
    view.centreX = x + (view.centreX - x) * keep;
    view.centreY = y + (view.centreY - y) * keep;
    view.fit = false;
  }
  for (const ImGuiMouseButton button : {ImGuiMouseButton_Right, ImGuiMouseButton_Middle}) {
    if (!ImGui::IsMouseDragging(button, 0)) continue;
    const ImVec2 moved = dragged(button);
    view.centreX -= moved.x / frame.size.x;
    view.centreY -= moved.y / frame.size.y;
    if (moved.x != 0 || moved.y != 0) view.fit = false;
    break;
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
  if (!view.showsPlane() || view.planeTexture.empty()) return {};
  return {&view.planeTexture, view.planeMade.legend};
}

/// The picture or pictures in the area; true with the pixel if the cursor is on one.
bool drawCanvas(Studio& studio, ImVec2 whole, ImVec2 room, int& x, int& y) {
  PictureView& view = studio.picture;
  // Below the caption, which had this height in the last frame.
  const ImVec2 canvas{whole.x, whole.y + view.captionHigh};
  ImVec2 area{room.x, std::max(1.0f, room.y - view.captionHigh)};
  const auto& reference = studio.workspace.reference();
  const int width = view.shown.width, height = view.shown.height;
  const InPlaceOfPicture other = inPlaceOfPicture(studio);
  const bool comparable = reference && sameSize(view.reference, view.shown);
  const bool differs = view.view == View::difference || view.view == View::falseColour;
  const bool together = differs || view.view == View::swipe || view.view == View::sideBySide;
  const bool refused = reference && !comparable && together && other.caption.empty();
  const View mode = reference && other.caption.empty() && !refused ? view.view : View::picture;
  const bool two = mode == View::sideBySide;
  const bool heat = other.texture == &view.planeTexture && view.planeMade.scale.white > 0;
  const bool scaled = heat || mode == View::falseColour;
  const bool counted = view.histogramShown && comparesPictures(studio) && !studio.stage && !other.texture &&
                       hasHistogram(mode);
  if (counted) area.y = std::max(1.0f, area.y - histogramHeight(room.y));
  ImVec2 part{two ? std::max(1.0f, (area.x - kGap) / 2) : area.x, area.y};
  ScalePlace scalePlace = ScalePlace::beside;
  if (scaled && view.fit) {  // a picture that is enlarged has no place of its own for it
    const FrameArea fitted = frameOf(view, whole, room, canvas, part, width, height);
    scalePlace =
        placeScale({area.x, area.y}, {fitted.size.x, fitted.size.y}, uprightScale(), flatScale(area.x));
    if (scalePlace == ScalePlace::over) part.x = std::max(area.x / 2, area.x - uprightScale());
  } else if (scaled) {
    part.x = area.x = std::max(area.x / 2, area.x - uprightScale());
  }
  const ImVec2 half{two ? std::max(1.0f, (room.x - kGap) / 2) : room.x, room.y};
  const FrameArea frame = frameOf(view, whole, half, canvas, part, width, height);
  const FrameArea second{{frame.low.x + part.x + kGap, frame.low.y}, frame.size};
  ImDrawList& list = *ImGui::GetWindowDrawList();

  const auto clipped = [&](ImVec2 low, ImVec2 high, const FrameArea& at, const Texture& texture) {
    list.PushClipRect(low, high, true);
    pictureIn(at, texture);
    list.PopClipRect();
  };
  const ImVec2 end{canvas.x + area.x, canvas.y + area.y};
  if (mode == View::picture)
    clipped(canvas, end, frame, other.texture ? *other.texture : view.pictureTexture);
  if (mode == View::reference)
    clipped(canvas, end, comparable ? frame : inside(frame, reference->width, reference->height),
            view.referenceTexture);
  if (two) {
    clipped(canvas, {canvas.x + part.x, end.y}, frame, view.pictureTexture);
    clipped({canvas.x + part.x + kGap, canvas.y}, end, second, view.referenceTexture);
  }
  float line = end.x;  // between picture and reference
  if (mode == View::swipe) {
    const float left = std::max(frame.low.x, canvas.x), right = std::min(frame.low.x + frame.size.x, end.x);
    line = std::round(left + (right - left) * view.swipe);
    clipped(canvas, {line, end.y}, frame, view.pictureTexture);
    clipped({line, canvas.y}, end, frame, view.referenceTexture);
    list.AddLine({line, canvas.y}, {line, end.y}, ImGui::GetColorU32(studio.palette().accent),
                 2 * studio.theme.scale);
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0) && right > left)
      view.swipe = std::clamp((ImGui::GetIO().MousePos.x - left) / (right - left), 0.0f, 1.0f);
  }
  if (differs && mode != View::picture) clipped(canvas, end, frame, view.differenceTexture);
  const ImVec2 corner{whole.x + 8, whole.y + 4};
  bool named = false;
  float captionEnd = whole.y - 4;
  if (!other.caption.empty()) {
    captionEnd = caption(corner, other.caption.c_str(), room.x - 16);
    landmark("caption");
  } else if (refused) {
    captionEnd = caption(corner,
                         ("not compared: the reference has another shape, " +
                          std::to_string(reference->width) + " x " + std::to_string(reference->height) +
                          "; the picture has " + std::to_string(width) + " x " + std::to_string(height))
                             .c_str(),
                         room.x - 16);
    landmark("caption");
  } else if (two || mode == View::swipe) {
    named = true;  // after the numbers, so that these fill every pixel
  } else if (mode != View::picture) {
    const bool largest = mode == View::falseColour && view.channel == ShownChannel::all;
    const std::string text = std::string(kViewNames[static_cast<int>(mode)]) +
                             (largest ? " of the largest difference of the channels" : "") +
                             (differs ? ": " + view.errors : std::string());
    captionEnd = caption(corner, text.c_str(), room.x - 16);
    landmark("caption");
  }
  view.captionHigh = captionEnd + 4 - whole.y;
  const Picture& linear = studio.workspace.referenceIsLinear() || !reference ? view.shown : view.levels;
  if (!other.texture) {
    if (mode == View::reference) {
      if (comparable) numbersInPixels(studio, frame, canvas, end, view.reference);
    } else if (differs && mode != View::picture) {
      numbersInPixels(studio, frame, canvas, end, view.difference);
    } else {
      numbersInPixels(studio, frame, canvas, {two ? canvas.x + part.x : line, end.y}, linear);
      if (two) numbersInPixels(studio, second, {canvas.x + part.x + kGap, canvas.y}, end, view.reference);
      if (mode == View::swipe) numbersInPixels(studio, frame, {line, canvas.y}, end, view.reference);
    }
  }
  if (heat) numbersInPixels(studio, frame, canvas, end, view.planeMade.values, 1);
  if (scaled) {
    const ColourScale scale =
        heat ? view.planeMade.scale
             : ColourScale{.white = 1 / static_cast<double>(view.magnify), .andMore = true};
    const auto colours = heat ? heatColor : falseColour;
    if (scalePlace == ScalePlace::below)
      drawFlatScale(frame.low.x, frame.low.x + frame.size.x, frame.low.y + frame.size.y, scale, colours);
    else
      drawScale(canvas, {whole.x + room.x, end.y}, scale, colours);
  }
  if (named) {
    caption({canvas.x + 8, canvas.y + 8}, "picture", area.x);
    const float wide = ImGui::CalcTextSize("reference").x + 2 * ImGui::GetStyle().FramePadding.x;
    caption({end.x - wide - 8, canvas.y + 8}, "reference", area.x);
  }
  if (counted) drawHistogram(studio, {canvas.x, end.y}, {whole.x + room.x, whole.y + room.y});

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
  const bool within = ImGui::IsItemHovered() && x >= 0 && y >= 0 && x < width && y < height;

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
    const float thick = studio.theme.scale;
    list.AddRect({low.x - thick, low.y - thick}, {high.x + thick, high.y + thick}, IM_COL32(0, 0, 0, 200), 0,
                 0, 3 * thick);
    list.AddRect(low, high, IM_COL32(255, 210, 60, 255), 0, 0, 1.5f * thick);
    list.PopClipRect();
  }
  return within;
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
  PictureView& view = studio.picture;
  const float options = isShown(studio, "Controls") ? 0 : view.optionsHeight;
  const ImVec2 area{room.x, room.y - below - options};
  if (area.x < 8 || area.y < 8) return;
  if (view.pictureTexture.empty() || view.waits) {
    ImGui::Dummy(area);
    drawStatus(studio, false, 0, 0);
  } else {
    int x = 0, y = 0;
    const bool inside = drawClickable(studio, canvas, area, x, y);
    drawStatus(studio, inside, x, y);
  }
  if (isShown(studio, "Controls")) return;
  const float top = ImGui::GetCursorPosY();
  drawFrequentOptions(studio);
  view.optionsHeight = ImGui::GetCursorPosY() - top;
}

}  // namespace trace::studio
