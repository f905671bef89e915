// The upper part of the panel Rays: the scene in space with the rays of a pixel in it.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "base/match.h"
#include "studio/landmarks.h"
#include "studio/rays_view.h"
#include "studio/studio.h"

namespace trace::studio {
namespace {

using Lines = std::vector<DrawLine>;

constexpr float kNear = 6;  // pixels from a ray that count as on it
constexpr std::size_t kMostNormals = 4000;
constexpr float kHidden = 0.6f;  // opacity of what lies behind surfaces

/// Collects lines, given in world space.
class Pen {
 public:
  Pen(const SceneModel& model, float scale) : model_(model), scale_(scale) {}
  Lines lines;

  void line(const Vec3& a, const Vec3& b, const Color& c, float opacity, float width, float dash = 0) {
    lines.push_back({model_.local(a),
                     model_.local(b),
                     {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), opacity},
                     width * scale_,
                     dash * scale_});
  }
  /// Corners numbered by bits: x, y, z.
  void box(const std::array<Vec3, 8>& corners, const Color& c, float opacity, float width) {
    for (std::size_t i = 0; i < 8; ++i)
      for (const std::size_t bit : {1u, 2u, 4u})
        if (!(i & bit)) line(corners[i], corners[i | bit], c, opacity, width);
  }

 private:
  const SceneModel& model_;
  float scale_;
};

Color toColor(const ImVec4& c) { return {c.x, c.y, c.z}; }

/// Asks for the scene's triangles when they have changed, and takes those that have come.
void updateModel(Studio& studio) {
  RaysView& view = studio.rays;
  const auto scene = studio.workspace.document.sharedScene();
  if (view.modelScene != scene) {
    const bool same = view.modelScene && sameSurfaces(*view.modelScene, *scene) &&
                      view.modelScene->materials == scene->materials;
    if (!same)
      view.modelTask.start([scene, modeler = view.modeler](const Cancelled& cancelled) {
        try {
          return modeler->model(*scene, cancelled);
        } catch (const std::exception&) {  // the render says what is wrong
          return SceneModel{};
        }
      });
    view.modelScene = scene;
  }
  if (auto model = view.modelTask.take()) {
    view.model = std::move(*model);
    view.drawer->setCorners(view.model.corners);
  }
}

/// Looks at what the scene's camera sees, once for each file.
void updateOrbit(Studio& studio) {
  RaysView& view = studio.rays;
  const auto session = studio.workspace.render.session();
  if (!session || session->scene().file == view.orbitFile) return;
  Box3 target = seenBy(session->world());
  if (target.empty()) target = session->world().bounds();
  if (target.empty() || !isFinite(target.size())) target = {{-1, -1, -1}, {1, 1, 1}};
  view.orbit = OrbitCamera(target, session->scene().camera);
  view.size = std::max(length(target.size()) / 2, 1e-30);
  view.orbitFile = session->scene().file;
}

// --- what there is to see -----------------------------------------------------------------------------

void addLight(const Light& light, const Vec3& target, Real radius, Pen& pen) {
  match(light, [&](const auto& l) {
    const Color c = clamp01(l.color / std::max(maxComponent(l.color), 1e-9)) * 0.9 + Color(0.1);
    const Real size = 0.1 * radius;
    if constexpr (requires { l.position; }) {
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z)
            if (const Vec3 d(x, y, z); x || y || z)
              pen.line(l.position + normalize(d) * (0.3 * size), l.position + normalize(d) * size, c, 1,
                       1.5f);
    } else if constexpr (requires { l.direction; }) {
      const Vec3 d = normalize(l.direction);
      Vec3 side = std::abs(d.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
      side = normalize(cross(d, side));
      const Vec3 other = cross(d, side);
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          const Vec3 tip = target - d * (1.3 * radius) + (side * i + other * j) * (1.5 * size);
          pen.line(tip - d * (4 * size), tip, c, 1, 1.5f);
          for (const Vec3& wing : {side, -side, other, -other})
            pen.line(tip, tip - d * (0.8 * size) + wing * (0.3 * size), c, 1, 1.5f);
        }
    }
  });
}

/// Of the scene's camera: the eye and the corners of a picture plane before it, from the top left, clockwise.
struct Frustum {
  Vec3 eye;
  std::array<Vec3, 4> corners;
};
Frustum frustumOf(const CameraFrame& f, Real distance) {
  const auto at = [&](Real x, Real y) { return f.eye + (f.look + f.right * x + f.up * y) * distance; };
  return {f.eye, {at(-0.5, 0.5), at(0.5, 0.5), at(0.5, -0.5), at(-0.5, -0.5)}};
}

void addNormals(const SceneModel& model, Real size, const Color& colour, Pen& pen) {
  const std::size_t corners = model.corners.size() / 6,
                    every = std::max<std::size_t>(1, corners / kMostNormals);
  for (std::size_t i = 0; i < corners; i += every) {
    const float* c = &model.corners[i * 6];
    const Vec3 p = Vec3(c[0], c[1], c[2]) * model.scale + model.origin;
    pen.line(p, p + Vec3(c[3], c[4], c[5]) * (0.06 * size), colour, 0.9f, 1);
  }
}

void addRays(const Studio& studio, const TracedPixel& pixel, bool pinned, Pen& pen) {
  const RaysView& view = studio.rays;
  const Real whole = std::max(maxComponent(pixel.tree().nodes.front().weight), 1e-30);
  for (const RaySegment& segment : pixel.segments) {
    const int i = segment.node;
    const RayNode& node = pixel.tree().nodes[static_cast<std::size_t>(i)];
    if (!view.lookShown[static_cast<std::size_t>(segment.looks)] || (!pinned && !view.inStep(i))) continue;
    const bool hot = !pinned && (i == view.hoveredBefore || i == view.selected || i == view.step - 1);
    const Color colour = pinned ? Color(0.6) : colourOf(segment.looks, studio.theme.light);
    const auto weight =
        static_cast<float>(std::sqrt(std::clamp(maxComponent(node.weight) / whole, 0.0, 1.0)));
    pen.line(segment.from, segment.to, hot ? lerp(0.35, colour, Color(studio.theme.light ? 0 : 1)) : colour,
             pinned ? 0.6f : 1, 1.2f + 2.2f * weight + (hot ? 1.0f : 0), segment.leaves ? 6.0f : 0);
    if (view.hitNormalsShown && node.hit && !pinned)
      pen.line(node.hit->surface.point,
               node.hit->surface.point + node.hit->surface.shading * (0.2 * view.size),
               toColor(studio.palette().good), 1, 1.5f);
  }
}

Lines collect(Studio& studio, const Frustum& frustum) {
  RaysView& view = studio.rays;
  const Scene& scene = studio.workspace.document.scene();
  Pen pen(view.model, studio.theme.scale);
  const Color accent = toColor(studio.palette().accent), muted = toColor(studio.palette().muted);
  for (const ScenePart& part : view.model.parts) {
    const bool selected = studio.selected == Studio::Selected::object && studio.selectedIndex == part.object;
    if (view.boundsShown || selected)
      pen.box(part.box, selected ? accent : muted, selected ? 1 : 0.7f, selected ? 2 : 1);
  }
  if (view.axesShown)
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 end;
      end[axis] = 0.5 * view.size;
      pen.line({}, end, Color(axis == 0 ? 0.95 : 0.2, axis == 1 ? 0.8 : 0.25, axis == 2 ? 1 : 0.25), 1, 2.5f);
    }
  if (view.normalsShown) addNormals(view.model, view.size, toColor(studio.palette().good), pen);
  if (view.lightsShown)
    for (const LightSource& source : scene.lights)
      addLight(source.light, view.orbit.target(), view.size, pen);
  if (view.cameraShown && !view.fromCamera)
    for (std::size_t i = 0; i < 4; ++i) {
      pen.line(frustum.eye, frustum.corners[i], muted, 1, 1.2f);
      pen.line(frustum.corners[i], frustum.corners[(i + 1) % 4], muted, 1, 1.2f);
    }
  if (const TracedPixel* pinned = studio.workspace.inspector.pinned(); pinned && view.pinnedShown)
    addRays(studio, *pinned, true, pen);
  if (const TracedPixel* pixel = shownPixel(studio)) addRays(studio, *pixel, false, pen);
  if (view.hierarchyShown && view.boxesOf >= 0)
    for (int i = 0; i < view.box; ++i) {
      const VisitedBox& box = view.boxes[static_cast<std::size_t>(i)];
      const bool last = i + 1 == view.box;
      pen.box(box.corners, last ? toColor(studio.palette().changed) : muted, last ? 1 : 0.35f,
              last ? 2.5f : 1);
    }
  return std::move(pen.lines);
}

void addSurfaces(const RaysView& view, SpaceDrawing& drawing) {
  constexpr float kGlass = 0.35f, kWire = 0.5f;
  if (view.surfaces == Surfaces::none) return;
  for (const ScenePart& part : view.model.parts) {
    DrawSurface surface{part.first, part.count, part.color, view.opacity};
    if (part.clear) surface.opacity = std::min(surface.opacity, kGlass);
    if (view.surfaces == Surfaces::wireframe) {
      surface.opacity = kWire;
      drawing.wires.push_back(surface);
    } else {
      (surface.opacity < 1 ? drawing.clear : drawing.solid).push_back(surface);
    }
  }
}

// --- the cursor ---------------------------------------------------------------------------------------

/// Distance in pixels of the cursor from the ray's line on the screen.
float distanceTo(const RaysView& view, const Matrix4& matrix, ImVec2 low, ImVec2 size,
                 const RaySegment& line) {
  const auto local = [&](const Vec3& p) { return (p - view.model.origin) / view.model.scale; };
  std::array<double, 4> a = transform(matrix, local(line.from)), b = transform(matrix, local(line.to));
  constexpr double kLeast = 1e-4;
  if (a[3] < kLeast && b[3] < kLeast) return 1e30f;
  const auto cut = [](std::array<double, 4>& out, const std::array<double, 4>& in) {
    const double t = (kLeast - out[3]) / (in[3] - out[3]);
    for (std::size_t i = 0; i < 4; ++i) out[i] += t * (in[i] - out[i]);
  };
  if (a[3] < kLeast) cut(a, b);
  if (b[3] < kLeast) cut(b, a);
  const auto screen = [&](const std::array<double, 4>& c) {
    return Vec2{low.x + (c[0] / c[3] + 1) / 2 * size.x, low.y + (1 - c[1] / c[3]) / 2 * size.y};
  };
  const Vec2 p = screen(a), q = screen(b);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double wx = q.x - p.x, wy = q.y - p.y, l = wx * wx + wy * wy;
  const double t = l > 0 ? std::clamp(((mouse.x - p.x) * wx + (mouse.y - p.y) * wy) / l, 0.0, 1.0) : 0;
  return static_cast<float>(std::hypot(p.x + t * wx - mouse.x, p.y + t * wy - mouse.y));
}

int rayUnderCursor(const Studio& studio, const Matrix4& matrix, ImVec2 low, ImVec2 size) {
  const RaysView& view = studio.rays;
  int nearest = -1;
  float least = kNear * studio.theme.scale;
  const TracedPixel* pixel = shownPixel(studio);
  if (!pixel) return -1;
  for (const RaySegment& segment : pixel->segments) {
    const int i = segment.node;
    if (!view.lookShown[static_cast<std::size_t>(segment.looks)] || !view.inStep(i)) continue;
    const float d = distanceTo(view, matrix, low, size, segment);
    if (d < least) least = d, nearest = i;
  }
  return nearest;
}

void moveCamera(RaysView& view, ImVec2 size) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool shift = io.KeyShift;
  if (ImGui::IsItemActive() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    const double dx = io.MouseDelta.x / size.y, dy = io.MouseDelta.y / size.y;
    if (ImGui::IsMouseDragging(0) && !shift) view.orbit.turn(-4 * dx, 4 * dy), view.fromCamera = false;
    if (ImGui::IsMouseDragging(1) || ImGui::IsMouseDragging(2) || (ImGui::IsMouseDragging(0) && shift))
      view.orbit.move(-dx, dy), view.fromCamera = false;
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0)
    view.orbit.approach(std::pow(0.85, io.MouseWheel)), view.fromCamera = false;
}

void selectObjectUnderCursor(Studio& studio, const CameraFrame& frame, ImVec2 low, ImVec2 size) {
  const auto session = studio.workspace.render.session();
  if (!session) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  Statistics statistics;
  const auto found = session->world().closest(
      frame.ray({(mouse.x - low.x) / size.x, 1 - (mouse.y - low.y) / size.y}), Faces::both, statistics);
  if (found && found->object < studio.workspace.document.scene().objects.size())
    studio.selected = Studio::Selected::object, studio.selectedIndex = found->object;
}

// --- switches -----------------------------------------------------------------------------------------

void drawSwitches(Studio& studio) {
  RaysView& view = studio.rays;
  const char* const kSurfaces[] = {"Shaded", "Wireframe", "No surfaces"};
  int surfaces = static_cast<int>(view.surfaces);
  ImGui::SetNextItemWidth(characters(18));
  if (ImGui::Combo("##surfaces", &surfaces, kSurfaces, 3)) view.surfaces = static_cast<Surfaces>(surfaces);
  ImGui::SameLine();
  if (ImGui::Button("Show...")) ImGui::OpenPopup("show");
  ImGui::SameLine();
  ImGui::Checkbox("from camera", &view.fromCamera);
  landmark("from camera");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("look as the scene's camera does; turning leaves it");
  ImGui::SameLine();
  if (ImGui::Button("Reset")) view.orbitFile.clear(), view.modelScene.reset(), view.fromCamera = false;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("look at everything again");
  if (!ImGui::BeginPopup("show")) return;
  ImGui::Checkbox("lights", &view.lightsShown);
  ImGui::Checkbox("camera", &view.cameraShown);
  ImGui::Checkbox("picture on its plane", &view.pictureShown);
  ImGui::Checkbox("axes: x red, y green, z blue", &view.axesShown);
  ImGui::Checkbox("bounding boxes", &view.boundsShown);
  ImGui::Checkbox("normals of surfaces", &view.normalsShown);
  ImGui::Checkbox("normals at hits", &view.hitNormalsShown);
  ImGui::Checkbox("pinned rays", &view.pinnedShown);
  ImGui::Checkbox("hierarchy boxes of the selected ray", &view.hierarchyShown);
  ImGui::SetNextItemWidth(characters(20));
  ImGui::SliderFloat("opacity", &view.opacity, 0.1f, 1, "%.2f");
  ImGui::EndPopup();
}

/// The classes that occur, each a switch, over the lower left corner.
void drawLegend(Studio& studio, ImVec2 low, ImVec2 size) {
  RaysView& view = studio.rays;
  const TracedPixel* pixel = shownPixel(studio);
  if (!pixel) return;
  std::array<int, kRayLooks.size()> count{};
  for (const RaySegment& segment : pixel->segments) ++count[static_cast<std::size_t>(segment.looks)];
  const auto rows = std::count_if(count.begin(), count.end(), [](int n) { return n > 0; });
  const float line = ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y * 0.5f;
  const float pad = ImGui::GetStyle().FramePadding.x;
  if (rows == 0) return;
  float widest = 0;
  for (const RayLook& each : kRayLooks) widest = std::max(widest, ImGui::CalcTextSize(each.name.data()).x);
  const float top = low.y + size.y - static_cast<float>(rows) * line - 2 * pad;
  const ImVec4 plate = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  ImGui::GetWindowDrawList()->AddRectFilled({low.x + pad / 2, top},
                                            {low.x + widest + 9 * pad, low.y + size.y - pad / 2},
                                            ImGui::GetColorU32(ImVec4(plate.x, plate.y, plate.z, 0.8f)), pad);
  ImVec2 at{low.x + pad, low.y + size.y - static_cast<float>(rows) * line - pad};
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] == 0) continue;
    const std::string text = std::string(kRayLooks[i].name) + "  " + std::to_string(count[i]);
    const ImVec2 wide = ImGui::CalcTextSize(text.c_str());
    const Color c = colourOf(static_cast<RayLooks>(i), studio.theme.light);
    const float side = ImGui::GetTextLineHeight() * 0.7f;
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::InvisibleButton("class", {wide.x + side + 3 * pad, line}))
      view.lookShown[i] = !view.lookShown[i];
    ImGui::PopID();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\nclick to show or hide", kRayLooks[i].help.data());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool on = view.lookShown[i];
    const ImU32 tint = ImGui::GetColorU32(
        ImVec4(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), 1));
    const ImVec2 square{at.x + pad, at.y + (line - side) / 2};
    if (on) list.AddRectFilled(square, {square.x + side, square.y + side}, tint, 2);
    list.AddRect(square, {square.x + side, square.y + side}, tint, 2);
    list.AddText({square.x + side + pad, at.y + (line - wide.y) / 2},
                 ImGui::GetColorU32(on ? ImGuiCol_Text : ImGuiCol_TextDisabled), text.c_str());
    at.y += line;
  }
}

}  // namespace

void drawSpace(Studio& studio) {
  RaysView& view = studio.rays;
  if (!view.drawer) view.drawer = std::make_unique<SceneDrawer>();
  drawSwitches(studio);
  updateModel(studio);
  updateOrbit(studio);
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
  moveCamera(view, size);

  const Document& document = studio.workspace.document;
  const Real aspect = size.x / size.y;
  const CameraFrame camera = frame(document.scene().camera, document.settings().cameraAxes);
  const CameraFrame world = view.fromCamera ? fitted(camera, aspect) : view.orbit.frame(aspect);
  CameraFrame local = world;
  local.eye = (world.eye - view.model.origin) / view.model.scale;
  // What matters is as far away as the target; the camera's view may begin inside something.
  const Real near = (view.fromCamera ? view.size : view.orbit.distance()) / view.model.scale;
  const Matrix4 matrix = projection(local, near * 0.01, near * 100 + 4);

  const ImGuiIO& io = ImGui::GetIO();
  const auto pixels = [](float length, float scale) { return std::max(1, static_cast<int>(length * scale)); };
  const ImVec4 background = ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg);
  SpaceDrawing drawing{.width = pixels(size.x, io.DisplayFramebufferScale.x),
                       .height = pixels(size.y, io.DisplayFramebufferScale.y),
                       .background = {background.x, background.y, background.z, 1},
                       .matrix = matrix,
                       .eye = local.eye,
                       .hidden = kHidden};
  addSurfaces(view, drawing);
  const Frustum frustum = frustumOf(camera, 0.5 * view.size / length(camera.look));
  const Texture& picture = studio.picture.pictureTexture;
  if (view.cameraShown && view.pictureShown && !view.fromCamera && !picture.empty()) {
    drawing.picture = DrawPicture{{}, picture.name(), picture.version(), 0.7f};
    for (std::size_t i = 0; i < 4; ++i) drawing.picture->corners[i] = view.model.local(frustum.corners[i]);
  }
  drawing.lines = collect(studio, frustum);
  ImGui::GetWindowDrawList()->AddImage(view.drawer->show(std::move(drawing)), low,
                                       {low.x + size.x, low.y + size.y}, {0, 1}, {1, 0});

  if (hovered && !ImGui::IsMouseDown(0)) {
    const int under = rayUnderCursor(studio, matrix, low, size);
    if (under >= 0) {
      const TracedPixel& pixel = *shownPixel(studio);
      view.hovered = under;
      if (under != view.hoveredBefore) view.scrollTo = under;
      ImGui::SetTooltip("%s: %s", look(pixel.looks(under)).name.data(),
                        sentence(pixel.tree().nodes[static_cast<std::size_t>(under)], pixel.scene()).c_str());
      if (clicked) view.selected = under;
    }
    if (clicked && under < 0) selectObjectUnderCursor(studio, world, low, size);
  }
  drawLegend(studio, low, size);
}

}  // namespace trace::studio
