#include "app/view/ray_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/explain/ray_segments.h"
#include "app/view/panel.h"
#include "app/view/space/room.h"
#include "app/view/space/scene_model.h"
#include "math/elementary.h"
#include "render/picture/passes.h"
#include "render/picture/render.h"
#include "scene/integrators.h"

namespace trace {
namespace {

constexpr double kPanelWidth = 640, kEdge = 16, kLine = 18;

/// The view of the world's camera, paler; white where nothing is.
DrawnPicture faint(const World& world, Settings settings, const Point2& at, double width, double height) {
  settings.width = static_cast<int>(width);
  settings.height = static_cast<int>(height);
  settings.region = {};
  settings.spp = 1;
  settings.subdivide = 0;
  settings.denoise = false;
  settings.timeLimit = 0;
  settings.depth = std::min(settings.depth, 2);
  settings.passes = {};
  Film film = makeFilm(settings, settings.width, settings.height);
  Job job;
  render(world, settings, film, job);
  Picture picture = film.picture();
  Statistics uncounted;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      Color& c = picture.at(x, y);
      const Ray ray = world.camera().ray({(x + 0.5) / picture.width, 1 - (y + 0.5) / picture.height});
      c = world.closest(ray, Faces::both, uncounted) ? lerp(0.6, clamp01(c), Color(1)) : Color(1);
    }
  return {at, std::move(picture)};
}

/// Where most of the rays are: a few that get far, such as to the end of a wide floor, do not make the others
/// small. Along these axes.
Box3 boxOf(const std::vector<RaySegment>& segments, const std::array<Vec3, 3>& axes) {
  constexpr std::size_t kMany = 20;
  std::array<std::vector<Real>, 3> along;
  const auto note = [&](const Vec3& p) {
    if (!isFinite(p)) return;
    for (std::size_t i = 0; i < 3; ++i) along[i].push_back(dot(p, axes[i]));
  };
  for (const RaySegment& segment : segments) {
    note(segment.from);
    if (!segment.leaves || along[0].size() < 2) note(segment.to);  // the first is that of the camera
  }
  Vec3 low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<Real>& all = along[i];
    if (all.empty()) return {};
    const auto few = all.size() < kMany ? std::ptrdiff_t{0} : std::ssize(all) / 20;
    const Real eye = all.front(), first = all[std::min<std::size_t>(1, all.size() - 1)];
    std::sort(all.begin(), all.end());
    low[static_cast<int>(i)] = std::min({all[static_cast<std::size_t>(few)], eye, first});
    high[static_cast<int>(i)] = std::max({all[all.size() - 1 - static_cast<std::size_t>(few)], eye, first});
  }
  return {low, high};
}

/// From the camera's right, far away, so that nothing is foreshortened; the camera looks to the right there,
/// and what is up for the scene's camera is up.
Camera sideCamera(const CameraFrame& front, const Vec3& updir, const std::vector<RaySegment>& segments,
                  double aspect) {
  const Vec3 right = normalize(front.right), ahead = normalize(cross(updir, right)), up = cross(right, ahead);
  const Box3 box = boxOf(segments, {ahead, up, right});
  const Vec3 center = box.center(), size = box.size();
  const Real half = std::max({size.y / 2, size.x / 2 / aspect, 1e-3 * size.z}) * 1.1;
  const Real distance = 30 * half + size.z;
  Camera camera;
  camera.position = ahead * center.x + up * center.y + right * (center.z + distance);
  camera.viewdir = -right;
  camera.updir = up;
  camera.fov = 2 * math::atan(half / distance) * 180 / kPi;
  camera.aspectratio = aspect;
  return camera;
}

class RayDrawing {
 public:
  RayDrawing(const RayTree& tree) : tree_(tree), segments_(raySegments(tree)) {}

  const std::vector<RaySegment>& segments() const { return segments_; }
  bool has(RayLooks looks) const {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const RaySegment& segment) { return segment.looks == looks; });
  }

  /// Shadow rays below, so that they hide no others; thicker, the more a ray counts.
  void rays(Drawing& drawing, const Panel& panel) const {
    const double whole = maxComponent(tree_.nodes[0].weight);
    for (const bool shadows : {true, false})
      for (const RaySegment& segment : segments_) {
        const RayNode& node = at(segment);
        if ((node.kind == RayKind::shadow) != shadows) continue;
        const double share = whole > 0 ? std::clamp(maxComponent(node.weight) / whole, 0.0, 1.0) : 0;
        const double width = shadows ? 1 : 1 + 2 * std::sqrt(share);
        panel.line(drawing, segment.from, segment.to, look(segment.looks).color, width, segment.leaves);
      }
    const Real normalLength = 0.04 * size();
    for (const RaySegment& segment : segments_)
      if (const auto& hit = at(segment).hit) {
        const Vec3& p = hit->surface.point;
        panel.line(drawing, p, p + hit->surface.shading * normalLength, kInk, 1, false);
        panel.disk(drawing, p, 2.5, look(segment.looks).color);
      } else if (segment.looks == RayLooks::shadowLit && !segment.leaves) {
        panel.disk(drawing, segment.to, 4, look(segment.looks).color);
      }
    panel.disk(drawing, tree_.nodes[0].ray.origin, 4, kInk);
  }

 private:
  const RayNode& at(const RaySegment& segment) const {
    return tree_.nodes[static_cast<std::size_t>(segment.node)];
  }
  Real size() const { return length(boxOf(segments_, {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).size()); }

  const RayTree& tree_;
  std::vector<RaySegment> segments_;
};

}  // namespace

Drawing drawRays(const Scene& scene, const Settings& settings, const World& world, const RayTree& tree) {
  const RayDrawing rays(tree);
  const double aspect =
      length(world.camera().right) / length(world.camera().up) * eyesAcross(settings.stereo);
  const double height = std::clamp(std::round(kPanelWidth / aspect), 100.0, 4 * kPanelWidth);
  const double top = kEdge + 2 * kLine, right = 2 * kEdge + kPanelWidth;
  Drawing drawing;
  drawing.width = static_cast<int>(2 * kPanelWidth + 3 * kEdge);
  const std::size_t legendRows = (kRayLooks.size() + 4) / 3;
  drawing.height = static_cast<int>(top + height + 2 * kEdge + static_cast<double>(legendRows) * kLine);
  const DrawnFrame whole{{0, 0}, static_cast<double>(drawing.width), static_cast<double>(drawing.height)};

  Scene sideScene = scene;
  sideScene.camera = sideCamera(world.camera(), scene.camera.updir, rays.segments(), kPanelWidth / height);
  const Settings sideSettings = plainView(settings);
  Messages ignored;  // said before, of the same scene
  const Compiled here{scene, settings, world};
  const World sideWorld = compile(sideScene, sideSettings, ignored, &here);

  using Walls = std::vector<std::uint32_t>;
  const Vec3& eye = scene.camera.position;
  const auto panel = [&](const World& w, const Settings& s, const Walls& walls, double x,
                         const std::string& title) {
    // One sample of all lights has no noise.
    const bool lit = hasTrait(s, Trait::asksAllLights) && walls.empty();
    drawing.things.push_back(DrawnWords{{x, top - kLine}, title, kInk});
    const Point2 corner{x, top};
    const Panel view(w.camera(), corner, kPanelWidth, height);
    drawing.things.push_back(view.frame());
    drawing.things.push_back(lit ? faint(w, s, corner, kPanelWidth, height)
                                 : sketch(w, walls, eye, corner, kPanelWidth, height));
    rays.rays(drawing, view);
    drawing.things.push_back(whole);
  };
  drawing.things.push_back(DrawnWords{{kEdge, kEdge / 2},
                                      "pixel " + std::to_string(tree.x) + "," + std::to_string(tree.y) +
                                          ", sample " + std::to_string(tree.sample) + ": " +
                                          std::to_string(tree.nodes.size()) +
                                          (tree.nodes.size() == 1 ? " ray" : " rays"),
                                      kInk});
  panel(world, settings, {}, kEdge, "from the camera");
  panel(sideWorld, sideSettings, wallsAround(world, eye, frameOf(scene)), right,
        "from the side: the camera looks to the right");

  // The legend, in three columns.
  double x = kEdge, y = top + height + kEdge;
  const auto entry = [&](const std::string& words, const Color& color, bool dashed) {
    drawing.things.push_back(DrawnLine{{x, y + kLine / 2}, {x + 36, y + kLine / 2}, color, 3, dashed});
    drawing.things.push_back(DrawnWords{{x + 46, y}, words, kInk});
    x += (2 * kPanelWidth + kEdge) / 3;
    if (x > 2 * kPanelWidth) {
      x = kEdge;
      y += kLine;
    }
  };
  for (std::size_t i = 0; i < kRayLooks.size(); ++i)
    if (rays.has(static_cast<RayLooks>(i))) entry(std::string(kRayLooks[i].help), kRayLooks[i].color, false);
  entry("dashed: leaves the scene", kInk, true);
  entry("short: the surface's normal", kInk, false);
  return drawing;
}

}  // namespace trace
