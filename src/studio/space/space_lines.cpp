#include "studio/space/space_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "math/elementary.h"
#include "math/perpendicular.h"
#include "shading/lights/goniometric_light.h"
#include "shading/lights/projector_light.h"
#include "studio/space/rays_view.h"
#include "studio/studio.h"

namespace trace::studio {
namespace {

using Lines = std::vector<DrawLine>;

constexpr std::size_t kMostNormals = 4000;

/// Collects lines, given in world space.
class Pen {
 public:
  Pen(const SceneModel& model, float scale) : model_(model), scale_(scale) {}
  Lines lines;

  void line(const Vec3& a, const Vec3& b, const Color& c, float opacity, float width, float dash = 0) {
    local(model_.local(a), model_.local(b), c, opacity, width, dash);
  }
  void local(const Point3& a, const Point3& b, const Color& c, float opacity, float width, float dash = 0) {
    lines.push_back({a,
                     b,
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

/// The sides of a cone or pyramid from a lamp, as long as `size`.
void addBeam(const Vec3& from, const AimFrame& aim, const Vec2& half, Real size, const Color& c, Pen& pen) {
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Real x = i == 0 || i == 3 ? -half.x : half.x, y = i < 2 ? -half.y : half.y;
    corners[i] = from + normalize(aim.ahead + aim.right * x + aim.up * y) * size;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    pen.line(from, corners[i], c, 0.8f, 1);
    pen.line(corners[i], corners[(i + 1) % 4], c, 0.8f, 1);
  }
}

/// A panel's sides, and how it faces.
template <class P>
void addPanel(const P& panel, const Color& c, Pen& pen) {
  const auto corner = [&](Real x, Real y) { return panel.position + panel.u * x + panel.v * y; };
  const std::array<Vec3, 4> corners{corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5),
                                    corner(-0.5, 0.5)};
  for (std::size_t i = 0; i < 4; ++i) pen.line(corners[i], corners[(i + 1) % 4], c, 1, 1.5f);
  const Vec3 across = cross(panel.u, panel.v);
  if (const Real area = length(across); area > 0)
    pen.line(panel.position, panel.position + across / area * (0.5 * std::sqrt(area)), c, 1, 1.5f);
}

/// Half the width of a cone at distance 1; wide ones are not drawn as cones.
std::optional<Real> halfWidth(Real degrees) {
  constexpr Real kWidest = 80;
  if (!(degrees < kWidest)) return {};
  return math::tan(degrees * kPi / 180);
}

void addLight(const Light& light, const Vec3& target, Real radius, Pen& pen) {
  Color c(0.6);
  if (const Color* color = light.color())
    c = clamp01(*color / std::max(maxComponent(*color), 1e-9)) * 0.9 + Color(0.1);
  const Real size = 0.1 * radius;
  const Vec3 *position = light.position(), *direction = light.direction();
  const LightGeometry geometry = geometryOf(light);
  if (geometry.u != Vec3{}) addPanel(geometry, c, pen);
  if (geometry.cone)
    if (const auto half = halfWidth(geometry.cone->angle))
      addBeam(*position, AimFrame(*direction, {0, 1, 0}), {*half, *half}, 4 * size, c, pen);
  if (const auto* projector = light.as<ProjectorLight>())
    addBeam(*position, AimFrame(*direction, projector->up), projector->half(), 4 * size, c, pen);
  if (light.is<GoniometricLight>())
    pen.line(*position, *position + normalize(*direction) * (2 * size), c, 1, 1.5f);
  if (position) {
    const auto star = [&](const Color& colour, float opacity, float width) {
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z)
            if (const Vec3 d(x, y, z); x || y || z)
              pen.line(*position + normalize(d) * (0.3 * size), *position + normalize(d) * size, colour,
                       opacity, width);
    };
    star(Color(0.1), 0.5f, 3);  // a rim, so that it is seen before a bright wall
    star(c, 1, 1.5f);
  } else if (direction) {
    const Vec3 d = normalize(*direction);
    const Vec3 side = perpendicularTo(d), other = cross(d, side);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        const Vec3 tip = target - d * (1.3 * radius) + (side * i + other * j) * (1.5 * size);
        pen.line(tip - d * (4 * size), tip, c, 1, 1.5f);
        for (const Vec3& wing : {side, -side, other, -other})
          pen.line(tip, tip - d * (0.8 * size) + wing * (0.3 * size), c, 1, 1.5f);
      }
  }
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

/// A head in the middle of a ray, which shows where it goes: strokes side by side, wider than the ray.
void addArrow(const RaySegment& segment, const Vec3& eye, const Color& c, float opacity, float width,
              Pen& pen) {
  constexpr Real kPlace = 0.55, kLong = 0.012, kLonger = 0.006, kWide = 0.5;
  const int strokes = 4 + static_cast<int>(2 * width);  // on each side; close enough to fill a large head
  const Vec3 along = segment.to - segment.from, tip = segment.from + along * kPlace;
  const Real far = length(along),
             size = std::min((kLong + kLonger * static_cast<Real>(width)) * length(tip - eye), 0.25 * far);
  const Vec3 across = cross(along, tip - eye);
  if (!(far > 0) || !(length(across) > 0)) return;
  const Vec3 back = tip - along * (size / far), side = across * (kWide * size / length(across));
  for (int i = -strokes; i <= strokes; ++i)
    pen.line(tip, back + side * (static_cast<Real>(i) / strokes), c, opacity, 1.5f);
}

void addRays(const Studio& studio, const TracedPixel& pixel, bool pinned, const Vec3& eye, Pen& pen) {
  const RaysView& view = studio.rays;
  const Real whole = std::max(maxComponent(pixel.tree().nodes.front().weight), 1e-30);
  const Color rim(0);
  for (const RaySegment& segment : pixel.segments) {
    const int i = segment.node;
    const RayNode& node = pixel.tree().nodes[static_cast<std::size_t>(i)];
    if (view.lookHidden[static_cast<std::size_t>(segment.looks)] ||
        (!pinned && (!view.inStep(i) || view.grows(i))))
      continue;
    const bool hot = !pinned && (i == view.selected || i == view.step - 1);
    const Color colour = pinned ? Color(0.6) : colourOf(segment.looks);
    const auto& way = view.wayRays;
    const bool chosen = !pinned && std::find(way.begin(), way.end(), i) != way.end();
    const bool faint = pinned || (!way.empty() && !chosen);
    const auto weight =
        chosen ? 1.0f
               : static_cast<float>(std::sqrt(std::clamp(maxComponent(node.weight) / whole, 0.0, 1.0)));
    const Color tint = hot ? lerp(0.35, colour, Color(1)) : colour;
    const float opacity = pinned ? 0.6f : faint ? 0.25f : 1, width = 1.0f + 3.0f * weight + (hot ? 1.0f : 0);
    if (!pinned && !faint)  // a rim, so that it is seen on any surface
      pen.line(segment.from, segment.to, rim, 0.6f, width + 2, segment.leaves ? 6.0f : 0);
    pen.line(segment.from, segment.to, tint, opacity, width, segment.leaves ? 6.0f : 0);
    addArrow(segment, eye, tint, opacity, width, pen);
    if (view.hitNormalsShown && node.hit && !pinned)
      pen.line(node.hit->surface.point,
               node.hit->surface.point + node.hit->surface.shading * (0.2 * view.size),
               toColor(studio.palette().good), 1, 1.5f);
  }
}

/// The photons counted at the place where a ray ended: each photon as it arrived, and the rim of their disk.
/// From far away they are enlarged about that place; the rim is dashed then.
void addPhotons(const RayNode& node, const Color& colour, const Vec3& eye, Pen& pen) {
  constexpr int kRim = 48;       // corners
  constexpr Real kLeast = 0.03;  // relative to the distance from which it is seen
  if (!node.hit) return;
  const Vec3 &middle = node.hit->surface.point, &normal = node.hit->surface.normal;
  for (const Term& term : node.terms) {
    if (!term.photons) continue;
    const Real least = kLeast * length(middle - eye);
    const Real radius = std::max(term.photons->radius, least), larger = radius / term.photons->radius;
    if (!std::isfinite(larger)) continue;
    Real brightest = 0;
    for (const Photon& p : term.photons->photons) brightest = std::max(brightest, maxComponent(p.power));
    for (const Photon& p : term.photons->photons) {
      const Color c = brightest > 0 ? p.power / brightest : Color(1);
      const Vec3 at = middle + (p.point - middle) * larger;
      pen.line(at - p.direction * (0.25 * radius), at, lerp(0.3, c, colour), 1, 1.5f);
    }
    const Basis basis = Frame{normal}.basis();
    Vec3 last;
    for (int i = 0; i <= kRim; ++i) {
      const Real angle = 2 * kPi * i / kRim;
      const Vec3 at = middle + basis.toWorld({math::cos(angle) * radius, math::sin(angle) * radius, 0});
      if (i > 0) pen.line(last, at, colour, 1, 1.5f, larger > 1 ? 3 : 0);
      last = at;
    }
  }
}

}  // namespace

Frustum frustumOf(const CameraFrame& f, Real distance) {
  const auto at = [&](Real x, Real y) { return f.eye + (f.look + f.right * x + f.up * y) * distance; };
  return {f.eye, {at(-0.5, 0.5), at(0.5, 0.5), at(0.5, -0.5), at(-0.5, -0.5)}};
}

std::vector<DrawLine> spaceLines(const Studio& studio, const Frustum& frustum, const Vec3& eye) {
  const RaysView& view = studio.rays;
  const Scene& scene = studio.workspace.document.scene();
  constexpr float kThicker = 1.6f;  // to be seen from the last row
  Pen pen(view.model, studio.theme.scale * (studio.stage ? kThicker : 1));
  const Color accent = toColor(studio.palette().accent), muted = toColor(studio.palette().muted);
  std::optional<std::uint32_t> boxed;  // the object of the part before
  for (const ScenePart& part : view.model.parts) {
    if (std::exchange(boxed, part.object) == part.object) continue;
    const bool selected = studio.selected == Studio::Selected::object && studio.selectedIndex == part.object;
    if (view.boundsShown || selected)
      pen.box(part.box, selected ? accent : muted, selected ? 1 : 0.7f, selected ? 2 : 1);
  }
  if (view.surfaces == Surfaces::shaded) {
    const Color edge = studio.theme.light ? Color(0.2, 0.3, 0.35) : Color(0.8, 0.9, 1);
    for (const auto& [from, to] : view.model.creases) pen.local(from, to, edge, 0.5f, 1);
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
    addRays(studio, *pinned, true, eye, pen);
  if (const TracedPixel* before = view.chains.before()) addRays(studio, *before, true, eye, pen);
  if (const TracedPixel* pixel = shownPixel(studio)) addRays(studio, *pixel, false, eye, pen);
  if (const TracedPixel* pixel = shownPixel(studio); pixel && view.selected >= 0)
    addPhotons(pixel->tree().nodes[static_cast<std::size_t>(view.selected)],
               toColor(studio.palette().changed), eye, pen);
  if (view.hierarchyShown && view.boxesOf >= 0)
    for (int i = 0; i < view.box; ++i) {
      const VisitedBox& box = view.boxes[static_cast<std::size_t>(i)];
      const bool last = i + 1 == view.box;
      pen.box(box.corners, last ? toColor(studio.palette().changed) : muted, last ? 1 : 0.35f,
              last ? 2.5f : 1);
    }
  return std::move(pen.lines);
}

}  // namespace trace::studio
