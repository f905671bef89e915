// The upper part of the panel Rays: the scene in space with the rays of a pixel in it.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/explain/pixel_why.h"
#include "app/view/magnifier.h"
#include "app/view/screen/overlays.h"
#include "app/view/space/room.h"
#include "math/elementary.h"
#include "scene/picture_size.h"
#include "studio/scene/selection.h"
#include "studio/space/gizmo_view.h"
#include "studio/space/rays_view.h"
#include "studio/space/space_lines.h"
#include "studio/studio.h"
#include "studio/widgets/drag.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr float kNear = 6;            // pixels from a ray that count as on it
constexpr float kHidden = 0.6f;       // opacity of what lies behind surfaces
constexpr double kMostLegend = 0.3;   // share of the view that the legend may cover
constexpr float kNamedLegend = 0.6f;  // largest share of a view that names in its legend may take

/// Asks for the scene's triangles when they have changed, and takes those that have come. Those of another
/// scene are gone at once.
void updateModel(Studio& studio) {
  RaysView& view = studio.rays;
  const auto scene = studio.workspace.document.sharedScene();
  if (view.modelOf != scene->file) {
    view.modelOf = scene->file;
    view.modelScene.reset();
    view.model = {};
    view.walls.clear();
    view.wallsOf.reset();
    view.built = false;
  }
  if (view.modelScene != scene || view.modelFineness != view.fineness) {
    if (!view.modelScene || view.modelFineness != view.fineness || !sameModel(*view.modelScene, *scene))
      view.modelTask.start(
          [scene, modeler = view.modeler, fineness = view.fineness](const Cancelled& cancelled) {
            try {
              return RaysView::Modelled{scene->file, modeler->model(*scene, cancelled, fineness)};
            } catch (const std::exception&) {  // the render says what is wrong
              return RaysView::Modelled{scene->file, {}};
            }
          });
    view.modelScene = scene;
    view.modelFineness = view.fineness;
  }
  if (auto made = view.modelTask.take(); made && made->file == view.modelOf) {
    if (made->model.warnings != view.model.warnings) studio.workspace.report(made->model.warnings);
    view.model = std::move(made->model);
    view.drawer->setCorners(view.model.shared);
    if (!std::exchange(view.built, true)) view.pace.begin();
  }
}

/// Looks at what the scene's camera sees, once for each file; at all there is, until that is known.
void updateOrbit(Studio& studio) {
  RaysView& view = studio.rays;
  const Scene& scene = studio.workspace.document.scene();
  if (view.orbitFile == scene.file) return;
  auto session = studio.workspace.render.session();
  if (session && session->scene().file != scene.file) session.reset();
  if (!session && view.orbitGuess == scene.file) return;
  const Box3 all = frameOf(scene);
  Box3 target = session ? seenBy(session->world(), all) : all;
  if (target.empty()) target = all;
  if (target.empty() || !isFinite(target.size())) target = {{-1, -1, -1}, {1, 1, 1}};
  view.orbit = OrbitCamera(target, scene.camera);
  view.size = std::max(length(target.size()) / 2, 1e-30);
  (session ? view.orbitFile : view.orbitGuess) = scene.file;
}

void updateWalls(Studio& studio) {
  RaysView& view = studio.rays;
  const auto session = studio.workspace.render.session();
  if (!session || session->scene().file != view.modelOf || view.wallsOf.lock() == session) return;
  view.walls = wallsAround(session->world(), session->scene().camera.position, frameOf(session->scene()));
  view.wallsOf = session;
}

/// Brings the rays of a pixel into sight once it is chosen.
void frameRays(Studio& studio) {
  RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  const bool shown = pixel && pixel->x == view.clickedX && pixel->y == view.clickedY;
  if (!view.frameDue || !shown || ImGui::IsMouseDown(0)) return;
  view.frameDue = false;
  constexpr Real kFar = 6, kLeast = 0.8;  // times the size of what the camera sees
  Box3 box = boundsOf(pixel->segments, kFar * view.size);
  if (view.fromCamera || box.empty()) return;
  const auto session = studio.workspace.render.session();
  std::vector<Vec3> hits;
  for (const RayNode& node : pixel->tree().nodes)
    if (node.hit) hits.push_back(node.hit->surface.point);
  const std::vector<std::uint32_t> walls = view.roomOpened ? view.walls : std::vector<std::uint32_t>{};
  const auto unhidden = [&] {
    return inSight(view.orbit, hits, session->world(), walls, session->scene().camera.position);
  };
  // A view that shows them well stays: rays of several pixels are compared in it.
  if (session && showsWell(view.orbit.frame(view.aspect), box, hits) &&
      unhidden().frame(1).eye == view.orbit.frame(1).eye)
    return;
  const Vec3 least = Vec3(1, 1, 1) * (kLeast * view.size);  // rays are seen with their surroundings
  const Vec3 room{std::max(0.0, least.x - box.size().x / 2), std::max(0.0, least.y - box.size().y / 2),
                  std::max(0.0, least.z - box.size().z / 2)};
  box = {box.low - room, box.high + room};
  view.orbit.lookAt(box);
  if (session) view.orbit = unhidden();
}

/// Parts of one look that follow each other are drawn as one.
void addOrExtend(std::vector<DrawSurface>& parts, const DrawSurface& part) {
  if (!parts.empty()) {
    DrawSurface& last = parts.back();
    DrawSurface both = part;
    both.first = last.first;
    both.count = last.count;
    if (both == last && last.first + last.count == part.first) {
      last.count += part.count;
      return;
    }
  }
  parts.push_back(part);
}

void addSurfaces(const RaysView& view, bool few, SpaceDrawing& drawing) {
  constexpr float kWire = 0.5f;
  if (view.surfaces == Surfaces::none) return;
  for (const ScenePart& part : view.model.parts) {
    const float own = static_cast<float>(part.opacity);
    constexpr Color kPlain(0.7);
    DrawSurface surface{few ? part.fewFirst : part.first, few ? part.fewCount : part.count,
                        view.materialsShown ? part.color : kPlain,
                        view.materialsShown ? std::min(view.opacity, own) : view.opacity};
    surface.wall = view.roomOpened && std::binary_search(view.walls.begin(), view.walls.end(), part.object);
    if (view.surfaces == Surfaces::wireframe) {
      surface.opacity = kWire;
      surface.wall = false;
      drawing.wires.push_back(surface);
    } else {
      addOrExtend(surface.opacity < 1 ? drawing.clear : drawing.solid, surface);
    }
  }
}

/// The scene's lights that have a place or a direction, the brightest as bright as white.
void addLights(const RaysView& view, const Scene& scene, SpaceDrawing& drawing) {
  drawing.flat = view.flat;
  if (!view.litByScene) return;
  Real brightest = 1e-30;
  for (const LightSource& source : scene.lights)
    if (const Color* color = source.light.color()) brightest = std::max(brightest, maxComponent(*color));
  for (const LightSource& source : scene.lights) {
    const Vec3 *position = source.light.position(), *direction = source.light.direction();
    const Color* color = source.light.color();
    if (drawing.lights.size() == SpaceDrawing::kMostLights) break;
    if (!color || (!position && !direction)) continue;
    drawing.lights.push_back({position ? (*position - view.model.origin) / view.model.scale : -*direction,
                              !position, *color * (0.85 / brightest)});
  }
}

// --- the cursor ---------------------------------------------------------------------------------------

/// A ray's line on the screen.
struct ScreenLine {
  Vec2 from, to;
};

/// None if it lies behind the eye.
std::optional<ScreenLine> onScreen(const RaysView& view, const Matrix4& matrix, ImVec2 low, ImVec2 size,
                                   const RaySegment& line) {
  const auto local = [&](const Vec3& p) { return (p - view.model.origin) / view.model.scale; };
  std::array<double, 4> a = transform(matrix, local(line.from)), b = transform(matrix, local(line.to));
  constexpr double kLeast = 1e-4;
  if (a[3] < kLeast && b[3] < kLeast) return {};
  const auto cut = [](std::array<double, 4>& out, const std::array<double, 4>& in) {
    const double t = (kLeast - out[3]) / (in[3] - out[3]);
    for (std::size_t i = 0; i < 4; ++i) out[i] += t * (in[i] - out[i]);
  };
  if (a[3] < kLeast) cut(a, b);
  if (b[3] < kLeast) cut(b, a);
  const auto screen = [&](const std::array<double, 4>& c) {
    return Vec2{low.x + (c[0] / c[3] + 1) / 2 * size.x, low.y + (1 - c[1] / c[3]) / 2 * size.y};
  };
  return ScreenLine{screen(a), screen(b)};
}

/// Distance in pixels of the cursor from the ray's line on the screen.
float distanceTo(const RaysView& view, const Matrix4& matrix, ImVec2 low, ImVec2 size,
                 const RaySegment& line) {
  const auto seen = onScreen(view, matrix, low, size, line);
  if (!seen) return 1e30f;
  const auto& [p, q] = *seen;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double wx = q.x - p.x, wy = q.y - p.y, l = wx * wx + wy * wy;
  const double t = l > 0 ? std::clamp(((mouse.x - p.x) * wx + (mouse.y - p.y) * wy) / l, 0.0, 1.0) : 0;
  return static_cast<float>(math::hypot(p.x + t * wx - mouse.x, p.y + t * wy - mouse.y));
}

int rayUnderCursor(const Studio& studio, const Matrix4& matrix, ImVec2 low, ImVec2 size) {
  const RaysView& view = studio.rays;
  int nearest = -1;
  float least = kNear * studio.theme.scale;
  const TracedPixel* pixel = shownPixel(studio);
  if (!pixel) return -1;
  for (const RaySegment& segment : pixel->segments) {
    const int i = segment.node;
    if (view.lookHidden[static_cast<std::size_t>(segment.looks)] || !view.inStep(i)) continue;
    const float d = distanceTo(view, matrix, low, size, segment);
    if (d < least) {
      least = d;
      nearest = i;
    }
  }
  return nearest;
}

/// A ray over the drawing, which is not drawn again for it.
void drawOver(const Studio& studio, const Matrix4& matrix, ImVec2 low, ImVec2 size,
              const RaySegment& segment) {
  const auto seen = onScreen(studio.rays, matrix, low, size, segment);
  if (!seen) return;
  const Color c = lerp(0.5, colourOf(segment.looks), Color(1));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(low, {low.x + size.x, low.y + size.y}, true);
  const auto point = [](const Vec2& p) { return ImVec2(static_cast<float>(p.x), static_cast<float>(p.y)); };
  list.AddLine(point(seen->from), point(seen->to),
               ImGui::GetColorU32(
                   ImVec4(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1)),
               4 * studio.theme.scale);
  list.PopClipRect();
}

/// The ray under the cursor, here or in the table.
void drawHovered(const Studio& studio, const Matrix4& matrix, ImVec2 low, ImVec2 size, int ray) {
  const TracedPixel* pixel = shownPixel(studio);
  if (pixel && ray >= 0 && static_cast<std::size_t>(ray) < pixel->segments.size())
    drawOver(studio, matrix, low, size, pixel->segments[static_cast<std::size_t>(ray)]);
}

/// The ray that grows while they play.
void drawGrowing(const Studio& studio, const Matrix4& matrix, ImVec2 low, ImVec2 size) {
  const RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  if (!pixel) return;
  for (RaySegment segment : pixel->segments) {
    if (!view.grows(segment.node) || view.lookHidden[static_cast<std::size_t>(segment.looks)]) continue;
    segment.to = segment.from + (segment.to - segment.from) * static_cast<Real>(view.grown);
    drawOver(studio, matrix, low, size, segment);
  }
}

/// The scene's light that is drawn at the cursor; none if there is none.
std::optional<std::size_t> lightUnderCursor(const Studio& studio, const Matrix4& matrix, ImVec2 low,
                                            ImVec2 size) {
  constexpr float kNearLight = 10;  // pixels
  const std::vector<LightSource>& lights = studio.workspace.document.scene().lights;
  std::optional<std::size_t> nearest;
  float least = kNearLight * studio.theme.scale;
  if (!studio.rays.lightsShown) return {};
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (const Vec3* position = lights[i].light.position()) {
      const float d = distanceTo(studio.rays, matrix, low, size, {.from = *position, .to = *position});
      if (d < least) least = d, nearest = i;
    }
  return nearest;
}

/// A mark at the edge of the view for each light that lies beyond it; a click on one selects the light.
void drawLightsBeyond(Studio& studio, const Matrix4& matrix, ImVec2 low, ImVec2 size) {
  const RaysView& view = studio.rays;
  const Scene& scene = studio.workspace.document.scene();
  constexpr std::size_t kMost = 16;  // more would be a frame of marks
  if (!view.lightsShown || scene.lights.size() > kMost) return;
  const float side = 7 * studio.theme.scale;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Vec3* position = scene.lights[i].light.position();
    if (!position) continue;
    const auto at = transform(matrix, (*position - view.model.origin) / view.model.scale);
    const bool behind = at[3] <= 0;
    const double w = std::abs(at[3]);
    if (!(w > 0) || (!behind && std::abs(at[0]) <= w && std::abs(at[1]) <= w)) continue;
    const Vec2 toward{at[0] / w * size.x, -at[1] / w * size.y};
    const Vec2 place = edgeMark({size.x, size.y}, toward, 2 * side);
    const ImVec2 mark{low.x + static_cast<float>(place.x), low.y + static_cast<float>(place.y)};
    const double far = std::max(math::hypot(toward.x, toward.y), 1e-12);
    const auto x = static_cast<float>(toward.x / far) * side, y = static_cast<float>(toward.y / far) * side;
    Color c(1);
    if (const Color* own = scene.lights[i].light.color())
      c = clamp01(*own / std::max(maxComponent(*own), 1e-9)) * 0.8 + Color(0.2);
    const ImU32 tint = ImGui::GetColorU32(
        ImVec4(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1));
    ImGui::SetCursorScreenPos({mark.x - side, mark.y - side});
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::InvisibleButton("light beyond", {2 * side, 2 * side}) && !studio.stage)
      studio.select(Studio::Selected::light, i);
    ImGui::PopID();
    landmark("light beyond " + std::to_string(i));
    if (ImGui::IsItemHovered()) {
      besideItem();
      ImGui::SetTooltip("%s lies beyond the view", entryName(scene.lights[i]).c_str());
    }
    const ImVec2 tip{mark.x + x * 1.6f, mark.y + y * 1.6f}, left{mark.x - y * 0.7f, mark.y + x * 0.7f},
        right{mark.x + y * 0.7f, mark.y - x * 0.7f};
    list.AddCircleFilled(mark, side * 0.75f, IM_COL32(0, 0, 0, 160));
    list.AddTriangleFilled(tip, left, right, tint);
    list.AddCircleFilled(mark, side * 0.5f, tint);
  }
}

/// The name of the ray under the cursor and the equation of its light, at the top of the view, or at its
/// bottom where the cursor or the legend is at the top: so it covers nothing near the ray.
void drawEquation(const Studio& studio, ImVec2 low, ImVec2 size, int ray) {
  const TracedPixel& pixel = *shownPixel(studio);
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  const float room = size.x - 4 * pad.x;
  const std::string said = sentence(pixel.tree().nodes[static_cast<std::size_t>(ray)], pixel.scene());
  const std::string text = inLines(std::string(look(pixel.looks(ray)).name) + ": " + said, room) + "\n" +
                           inLines(equationOf(pixel.tree(), pixel.scene(), ray), room);
  const ImVec2 wide = ImGui::CalcTextSize(text.c_str());
  const float high = wide.y + 2 * pad.y, gap = ImGui::GetTextLineHeight();
  const float mouse = ImGui::GetIO().MousePos.y;
  const bool aboveFree = mouse >= low.y + pad.y + high + gap,
             belowFree = mouse <= low.y + size.y - pad.y - high - gap;
  const bool below = !aboveFree || (belowFree && isUpper(studio.rays.legendCorner));
  const ImVec2 at{low.x + pad.x, below ? low.y + size.y - pad.y - high : low.y + pad.y};
  const ImVec4 plate = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + wide.x + 2 * pad.x, at.y + high},
                     ImGui::GetColorU32(ImVec4(plate.x, plate.y, plate.z, 0.85f)), pad.x);
  list.AddText({at.x + pad.x, at.y + pad.y}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

/// How far away is what the middle of the camera's picture shows?
Real distanceAhead(const Studio& studio, const CameraFrame& camera) {
  const auto session = studio.workspace.render.session();
  Statistics statistics;
  const auto found =
      session ? session->world().closest(camera.ray({0.5, 0.5}), Faces::both, statistics) : std::nullopt;
  const Real distance = found ? found->t : length(studio.rays.orbit.target() - camera.eye);
  return std::clamp(distance, 0.01 * studio.rays.size, 100 * studio.rays.size);
}

/// The effect of the mouse on the view; it begins where the view from the camera is.
void moveCamera(Studio& studio, const CameraFrame& camera, ImVec2 size) {
  RaysView& view = studio.rays;
  const ImGuiIO& io = ImGui::GetIO();
  const bool shift = io.KeyShift;
  const bool drags = ImGui::IsItemActive() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0) &&
                     (ImGui::IsMouseDragging(0) || ImGui::IsMouseDragging(1) || ImGui::IsMouseDragging(2));
  const bool zooms = ImGui::IsItemHovered() && io.MouseWheel != 0;
  if (view.fromCamera && (drags || zooms)) {
    const Vec3& updir = studio.workspace.document.scene().camera.updir;
    view.orbit = OrbitCamera::from(camera, updir, distanceAhead(studio, camera));
    view.fromCamera = false;
  }
  if (drags) {
    const double dx = io.MouseDelta.x / size.y, dy = io.MouseDelta.y / size.y;
    if (ImGui::IsMouseDragging(0) && !shift) view.orbit.turn(-4 * dx, 4 * dy);
    if (ImGui::IsMouseDragging(1) || ImGui::IsMouseDragging(2) || (ImGui::IsMouseDragging(0) && shift))
      view.orbit.move(-dx, dy);
  }
  if (zooms) view.orbit.approach(math::pow(0.85, io.MouseWheel));
}

void selectObjectUnderCursor(Studio& studio, const CameraFrame& frame, ImVec2 low, ImVec2 size) {
  const auto session = studio.workspace.render.session();
  if (!session) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const RaysView& view = studio.rays;
  const auto found = closestShown(
      session->world(), frame.ray({(mouse.x - low.x) / size.x, 1 - (mouse.y - low.y) / size.y}),
      view.roomOpened ? view.walls : std::vector<std::uint32_t>{}, session->scene().camera.position);
  if (found && found->object < studio.workspace.document.scene().objects.size())
    studio.select(Studio::Selected::object, found->object);
}

// --- switches -----------------------------------------------------------------------------------------

void chooseSurfaces(RaysView& view, float wide) {
  const char* const kSurfaces[] = {"Shaded", "Wireframe", "No surfaces"};
  int surfaces = static_cast<int>(view.surfaces);
  ImGui::SetNextItemWidth(wide);
  if (ImGui::Combo("##surfaces", &surfaces, kSurfaces, 3)) view.surfaces = static_cast<Surfaces>(surfaces);
}

void resetButton(RaysView& view) {
  if (ImGui::Button("Reset")) {
    view.orbitFile.clear();
    view.orbitGuess.clear();
    view.modelScene.reset();
    view.fromCamera = false;
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("look at everything again");
}

/// One line, however narrow the view is: what has no room moves into "Show...".
void drawSwitches(Studio& studio) {
  RaysView& view = studio.rays;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float surfaces = characters(14), handles = characters(10), gap = style.ItemSpacing.x;
  const bool handled = studio.selected == Studio::Selected::object;
  const auto button = [&](const char* label) {
    return ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x + gap;
  };
  float needed = button("Show...") + ImGui::GetFrameHeight() + button("from camera");
  if (handled) needed += handles + gap;
  const float room = ImGui::GetContentRegionAvail().x;
  const bool resets = needed + button("Reset") <= room,
             chooses = needed + button("Reset") + surfaces + gap <= room;
  if (chooses) {
    chooseSurfaces(view, surfaces);
    ImGui::SameLine();
  }
  if (ImGui::Button("Show...")) ImGui::OpenPopup("show");
  ImGui::SameLine();
  ImGui::Checkbox("from camera", &view.fromCamera);
  landmark("from camera");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("look as the scene's camera does; turning leaves it");
  if (handled) {
    const char* const kModes[] = {"Move", "Turn", "Scale"};
    int mode = static_cast<int>(view.gizmo.mode);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(handles);
    if (ImGui::Combo("##gizmo", &mode, kModes, 3)) view.gizmo.mode = static_cast<GizmoMode>(mode);
    landmark("gizmo");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("what the handles of the selected object do (M, T, S)");
  }
  if (resets) {
    ImGui::SameLine();
    resetButton(view);
  }
  besidePanel();  // so that what the switches do is seen
  if (!ImGui::BeginPopup("show")) return;
  if (!chooses) chooseSurfaces(view, surfaces);
  if (!resets) resetButton(view);
  ImGui::Checkbox("lights", &view.lightsShown);
  ImGui::Checkbox("camera", &view.cameraShown);
  ImGui::Checkbox("picture on its plane", &view.pictureShown);
  ImGui::Checkbox("axes: x red, y green, z blue", &view.axesShown);
  ImGui::Checkbox("bounding boxes", &view.boundsShown);
  ImGui::Checkbox("normals of surfaces", &view.normalsShown);
  ImGui::Checkbox("colours of materials", &view.materialsShown);
  ImGui::Checkbox("flat shading: one normal for each triangle", &view.flat);
  ImGui::Checkbox("lit by the scene's lights, not from the eye", &view.litByScene);
  ImGui::Checkbox("into closed rooms, from outside", &view.roomOpened);
  ImGui::Checkbox("normals at hits", &view.hitNormalsShown);
  ImGui::Checkbox("pinned rays", &view.pinnedShown);
  ImGui::Checkbox("a click brings its rays into sight", &view.raysFramed);
  ImGui::Checkbox("hierarchy boxes of the selected ray", &view.hierarchyShown);
  ImGui::SetNextItemWidth(characters(20));
  const char* const kFineness[] = {"coarse", "usual", "fine", "finest"};
  int finer = std::clamp(static_cast<int>(std::lround(math::log2(view.fineness))) + 1, 0, 3);
  if (ImGui::Combo("triangles", &finer, kFineness, 4)) view.fineness = math::exp2(finer - 1);
  landmark("triangles");
  ImGui::SetNextItemWidth(characters(20));
  ImGui::SliderFloat("opacity", &view.opacity, 0.1f, 1, "%.2f");
  escapable(view.opacity);
  ImGui::EndPopup();
}

/// The rays that are drawn, in pixels from the view's upper left corner.
std::vector<ViewLine> shownLines(const Studio& studio, const Matrix4& matrix, ImVec2 size) {
  const RaysView& view = studio.rays;
  std::vector<ViewLine> lines;
  for (const RaySegment& segment : shownPixel(studio)->segments) {
    if (view.lookHidden[static_cast<std::size_t>(segment.looks)] || !view.inStep(segment.node)) continue;
    if (const auto seen = onScreen(view, matrix, {0, 0}, size, segment))
      lines.push_back({seen->from, seen->to});
  }
  return lines;
}

/// The classes that occur, each a switch, over a corner where they hide little; without names where they do
/// not fit.
void drawLegend(Studio& studio, const Matrix4& matrix, ImVec2 low, ImVec2 size) {
  RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  if (!pixel) return;
  std::array<int, kRayLooks.size()> count{};
  std::array<int, kRayLooks.size()> there{};  // those that are in the view by now
  for (const RaySegment& segment : pixel->segments) {
    ++count[static_cast<std::size_t>(segment.looks)];
    there[static_cast<std::size_t>(segment.looks)] += view.inStep(segment.node);
  }
  const auto classes = std::count_if(count.begin(), count.end(), [](int n) { return n > 0; });
  const float line = ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y * 0.5f;
  const float pad = ImGui::GetStyle().FramePadding.x;
  const float fit = std::floor((size.y - 2 * pad) / line);
  if (classes == 0 || fit < 1) return;
  const auto textOf = [&](std::size_t i, bool withNames) {
    return (withNames ? std::string(kRayLooks[i].name) + "  " : "") + std::to_string(there[i]);
  };
  const auto columns = std::ceil(static_cast<float>(classes) / fit);
  const auto rows = std::ceil(static_cast<float>(classes) / columns);
  const float side = ImGui::GetTextLineHeight() * 0.7f;
  const auto widestOf = [&](bool withNames) {
    float widest = 0;
    for (std::size_t i = 0; i < count.size(); ++i)
      if (count[i] > 0) widest = std::max(widest, ImGui::CalcTextSize(textOf(i, withNames).c_str()).x);
    return widest;
  };
  const bool named = columns == 1 && widestOf(true) + side + 3 * pad <= kNamedLegend * size.x;
  const float widest = widestOf(named);
  const float column = widest + side + 3 * pad;
  const Vec2 all{size.x, size.y}, wide{columns * column + 2 * pad, rows * line + 2 * pad};
  if (wide.x * wide.y > kMostLegend * all.x * all.y) return;
  if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2))
    view.legendCorner = quietCorner(all, wide, shownLines(studio, matrix, size), view.legendCorner);
  const Vec2 corner = placeIn(view.legendCorner, all, wide);
  const ImVec2 first{low.x + static_cast<float>(corner.x) + pad, low.y + static_cast<float>(corner.y) + pad};
  const ImVec4 plate = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  ImGui::GetWindowDrawList()->AddRectFilled(
      {first.x - pad / 2, first.y - pad / 2},
      {first.x + columns * column + pad / 2, first.y + rows * line + pad / 2},
      ImGui::GetColorU32(ImVec4(plate.x, plate.y, plate.z, 0.8f)), pad);
  ImVec2 at = first;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] == 0) continue;
    const std::string text = textOf(i, named);
    const ImVec2 letters = ImGui::CalcTextSize(text.c_str());
    const Color c = colourOf(static_cast<RayLooks>(i));
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::InvisibleButton("class", {letters.x + side + 3 * pad, line}))
      view.lookHidden[i] = !view.lookHidden[i];
    ImGui::PopID();
    landmark("legend " + std::string(kRayLooks[i].name));
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s: %s\nclick to show or hide", kRayLooks[i].name.data(), kRayLooks[i].help.data());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool on = !view.lookHidden[i];
    const ImU32 tint = ImGui::GetColorU32(
        ImVec4(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1));
    const ImVec2 square{at.x + pad, at.y + (line - side) / 2};
    if (on) list.AddRectFilled(square, {square.x + side, square.y + side}, tint, 2);
    list.AddRect(square, {square.x + side, square.y + side},
                 on ? ImGui::GetColorU32(ImGuiCol_TextDisabled) : tint, 2);
    list.AddText({square.x + side + pad, at.y + (line - letters.y) / 2},
                 ImGui::GetColorU32(on ? ImGuiCol_Text : ImGuiCol_TextDisabled), text.c_str());
    at.y += line;
    if (at.y > first.y + (rows - 0.5f) * line) at = {at.x + column, first.y};
  }
}

}  // namespace

void drawSpace(Studio& studio) {
  RaysView& view = studio.rays;
  if (!view.drawer) view.drawer = std::make_unique<SceneDrawer>();
  if (!studio.stage) drawSwitches(studio);
  updateModel(studio);
  updateOrbit(studio);
  frameRays(studio);
  updateWalls(studio);
  const ImVec2 low = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  if (size.x < 16 || size.y < 16) return;
  ImGui::InvisibleButton("space", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  landmark("space");
  ImGui::SetItemAllowOverlap();  // the legend
  const bool hovered = ImGui::IsItemHovered();
  const bool clicked = hovered && ImGui::IsMouseReleased(0) && ImGui::GetMouseDragDelta(0).x == 0 &&
                       ImGui::GetMouseDragDelta(0).y == 0;
  const Document& document = studio.workspace.document;
  if (!view.built) {
    const char* text = "building ...";
    const ImVec2 wide = ImGui::CalcTextSize(text);
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                                              ImGui::GetColorU32(ImGuiCol_MenuBarBg));
    ImGui::GetWindowDrawList()->AddText({low.x + (size.x - wide.x) / 2, low.y + (size.y - wide.y) / 2},
                                        ImGui::GetColorU32(ImGuiCol_TextDisabled), text);
    return;
  }
  const Real aspect = view.aspect = size.x / size.y;
  const CameraFrame camera =
      frame(cameraFor(document.scene(), document.settings()), document.settings().cameraAxes);
  const SpaceFrame before{low, size, view.fromCamera ? fitted(camera, aspect) : view.orbit.frame(aspect)};
  const bool holds = !studio.stage && dragGizmo(studio, before);
  if (!holds) moveCamera(studio, fitted(camera, aspect), size);
  const CameraFrame world = view.fromCamera ? fitted(camera, aspect) : view.orbit.frame(aspect);
  CameraFrame local = world;
  local.eye = (world.eye - view.model.origin) / view.model.scale;
  // The interesting part is as far away as the target; the camera's view may begin inside something.
  const Real near = (view.fromCamera ? view.size : view.orbit.distance()) / view.model.scale;
  const Matrix4 matrix = projection(local, near * 0.01, near * 100 + 4);

  const ImGuiIO& io = ImGui::GetIO();
  const auto pixels = [](float length, float scale) { return std::max(1, static_cast<int>(length * scale)); };
  const ImVec4 background = ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg);
  const bool held = ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
  const Left left = view.pace.after(held, io.DeltaTime);
  const float share = left == Left::pixels ? 0.5f : 1;
  SpaceDrawing drawing{.width = pixels(size.x, share * io.DisplayFramebufferScale.x),
                       .height = pixels(size.y, share * io.DisplayFramebufferScale.y),
                       .background = {background.x, background.y, background.z, 1},
                       .matrix = matrix,
                       .eye = local.eye,
                       .inside = (camera.eye - view.model.origin) / view.model.scale,
                       .hidden = kHidden};
  addSurfaces(view, left != Left::nothing, drawing);
  addLights(view, document.scene(), drawing);
  const Frustum frustum = frustumOf(camera, 0.5 * view.size / length(camera.look));
  const Texture& picture = studio.picture.pictureTexture;
  if (view.cameraShown && view.pictureShown && !view.fromCamera && !picture.empty()) {
    // While it is rendered it is new many times a second.
    constexpr double kLeastInterval = 1;  // seconds
    if (const double now = ImGui::GetTime();
        !studio.workspace.render.state().working() ||
        (now - view.pictureSince > kLeastInterval && !view.drawer->coarse())) {
      view.pictureVersion = picture.version();
      view.pictureSince = now;
    }
    drawing.picture = DrawPicture{{}, picture.name(), view.pictureVersion, 0.7f};
    for (std::size_t i = 0; i < 4; ++i) drawing.picture->corners[i] = view.model.local(frustum.corners[i]);
  }
  drawing.lines = spaceLines(studio, frustum, world.eye);
  for (DrawLine& line : drawing.lines) {
    line.width *= share;
    line.dash *= share;
  }
  const bool rests = !held && studio.window.rested() > RaysView::kRest;
  ImGui::GetWindowDrawList()->AddImage(view.drawer->show(std::move(drawing), rests), low,
                                       {low.x + size.x, low.y + size.y}, {0, 1}, {1, 0});
  view.coarse = !held && view.drawer->coarse();

  const bool onHandle = !studio.stage && drawGizmo(studio, {low, size, world});
  if (hovered && !ImGui::IsMouseDown(0) && !onHandle) {
    const int under = rayUnderCursor(studio, matrix, low, size);
    if (under >= 0) {
      view.hovered = under;
      if (under != view.hoveredBefore) view.scrollTo = under;
      if (clicked) view.selected = under;
    }
    if (clicked && under < 0 && !studio.stage) {
      if (const auto light = lightUnderCursor(studio, matrix, low, size))
        studio.select(Studio::Selected::light, *light);
      else
        selectObjectUnderCursor(studio, world, low, size);
    }
  }
  drawHovered(studio, matrix, low, size, view.hovered >= 0 ? view.hovered : view.hoveredBefore);
  drawGrowing(studio, matrix, low, size);
  drawLightsBeyond(studio, matrix, low, size);
  drawLegend(studio, matrix, low, size);
  if (hovered && view.hovered >= 0) drawEquation(studio, low, size, view.hovered);
}

}  // namespace trace::studio
