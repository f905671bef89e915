#include "app/view/gizmo.h"

#include <algorithm>
#include <cmath>

#include "app/editing/placing.h"
#include "math/elementary.h"
#include "math/perpendicular.h"

namespace trace {
namespace {

constexpr Real kShare = 0.16;  // length of an axis: share of the height of the view
constexpr int kRing = 64;      // corners

/// The place on the screen, with x in units of the height too.
std::optional<Vec2> seen(const CameraFrame& view, const Vec3& point) {
  const std::optional<Vec2> place = view.placeOf(point);
  if (!place) return {};
  return Vec2{place->x * length(view.right) / length(view.up), place->y};
}

Vec2 onScreen(const CameraFrame& view, const Vec2& place) {
  return {place.x * length(view.right) / length(view.up), place.y};
}

Real distanceTo(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along{b.x - a.x, b.y - a.y};
  const Real l = along.x * along.x + along.y * along.y;
  const Real t = l > 0 ? std::clamp(((p.x - a.x) * along.x + (p.y - a.y) * along.y) / l, 0.0, 1.0) : 0;
  return math::hypot(a.x + t * along.x - p.x, a.y + t * along.y - p.y);
}

/// How far along the axis the point is that is nearest to the ray through the place.
std::optional<Real> alongAxis(const Gizmo& gizmo, const Vec3& axis, const CameraFrame& view,
                              const Vec2& place) {
  const Ray ray = view.ray(place);
  const Vec3 between = gizmo.center - ray.origin;
  const Real b = dot(axis, ray.direction), d = dot(axis, between), e = dot(ray.direction, between);
  const Real across = 1 - b * b;
  constexpr Real kLeast = 1e-4;  // the axis points at the eye
  if (across < kLeast) return {};
  return (b * e - d) / across;
}

/// Where the ray through the place meets the plane through the center.
std::optional<Vec3> onPlane(const Gizmo& gizmo, const Vec3& normal, const CameraFrame& view,
                            const Vec2& place) {
  const Ray ray = view.ray(place);
  const Real facing = dot(normal, ray.direction);
  constexpr Real kLeast = 0.1;  // seen from its edge
  if (std::abs(facing) < kLeast) return {};
  const Real t = dot(normal, gizmo.center - ray.origin) / facing;
  if (!(t > 0)) return {};
  return ray.origin + ray.direction * t;
}

Affine about(const Vec3& center, const Affine& linearPart) {
  return Affine::translation(center) * linearPart * Affine::translation(-center);
}

/// Steps of drags, so that short numbers come out: a hundredth of a handle's length or less, to a power of
/// ten; a degree; a hundredth.
constexpr Real kFactorStep = 0.01;
Real inSteps(Real value, Real step) { return std::round(value / step) * step; }
Real stepOf(const Gizmo& gizmo) {
  return math::pow(10, std::floor(math::log(gizmo.size / 100) / math::log(10.0)));
}

std::optional<Affine> moved(const Gizmo& gizmo, int handle, const CameraFrame& view, const Vec2& from,
                            const Vec2& to) {
  if (handle == Gizmo::kWhole) {
    const Vec3 normal = normalize(view.look);
    const auto a = onPlane(gizmo, normal, view, from), b = onPlane(gizmo, normal, view, to);
    if (!a || !b) return {};
    const Vec3 by = *b - *a;
    const Real step = stepOf(gizmo);
    return Affine::translation({inSteps(by.x, step), inSteps(by.y, step), inSteps(by.z, step)});
  }
  const Vec3& axis = gizmo.axes[static_cast<std::size_t>(handle)];
  const auto a = alongAxis(gizmo, axis, view, from), b = alongAxis(gizmo, axis, view, to);
  if (!a || !b) return {};
  return Affine::translation(axis * inSteps(*b - *a, stepOf(gizmo)));
}

/// The angle about the axis between two places, in its plane, or on the screen if that is seen from its edge.
std::optional<Real> angleBetween(const Gizmo& gizmo, const Vec3& axis, const CameraFrame& view,
                                 const Vec2& from, const Vec2& to) {
  const auto a = onPlane(gizmo, axis, view, from), b = onPlane(gizmo, axis, view, to);
  if (a && b) {
    const Vec3 p = *a - gizmo.center, q = *b - gizmo.center;
    return math::atan2(dot(axis, cross(p, q)), dot(p, q));
  }
  const auto center = seen(view, gizmo.center);
  if (!center) return {};
  const Vec2 p = onScreen(view, from), q = onScreen(view, to);
  const Real angle =
      math::atan2(q.y - center->y, q.x - center->x) - math::atan2(p.y - center->y, p.x - center->x);
  return dot(axis, view.eye - gizmo.center) < 0 ? -angle : angle;
}

std::optional<Affine> turnedBy(const Gizmo& gizmo, int handle, const CameraFrame& view, const Vec2& from,
                               const Vec2& to) {
  const Vec3 axis = handle == Gizmo::kWhole ? normalize(view.eye - gizmo.center)
                                            : gizmo.axes[static_cast<std::size_t>(handle)];
  const auto angle = angleBetween(gizmo, axis, view, from, to);
  if (!angle) return {};
  return about(gizmo.center, Affine::rotation(axis, inSteps(*angle, kPi / 180)));
}

std::optional<Affine> scaled(const Gizmo& gizmo, int handle, const CameraFrame& view, const Vec2& from,
                             const Vec2& to) {
  if (handle == Gizmo::kWhole) {
    const auto center = seen(view, gizmo.center);
    if (!center) return {};
    // As if the handle, which is at the center, were as far out as the axes are long.
    const Real dx = (to.x - from.x) * length(view.right) / length(view.up), dy = to.y - from.y;
    const Real factor = inSteps(math::exp2((dx + dy) / kShare), kFactorStep);
    if (!isFactor(factor)) return {};
    return about(gizmo.center, Affine::scaling(Vec3(1, 1, 1) * factor));
  }
  const Vec3& axis = gizmo.axes[static_cast<std::size_t>(handle)];
  const auto a = alongAxis(gizmo, axis, view, from), b = alongAxis(gizmo, axis, view, to);
  if (!a || !b || *a == 0) return {};
  const Real factor = inSteps(*b / *a, kFactorStep);
  if (!(factor > 0) || !isFactor(factor)) return {};
  Affine along;
  for (int i = 0; i < 3; ++i) along.row[i] = along.row[i] + axis * ((factor - 1) * axis[i]);
  return about(gizmo.center, along);
}

}  // namespace

Gizmo gizmoFor(GizmoMode mode, const Affine& placed, const Vec3& center, const CameraFrame& view) {
  Gizmo gizmo{.mode = mode, .center = center, .axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  const Real distance = dot(center - view.eye, normalize(view.look));
  gizmo.size = kShare * std::max(distance, 1e-30) * length(view.up) / length(view.look);
  if (mode != GizmoMode::scale) return gizmo;
  for (int i = 0; i < 3; ++i) {
    const Vec3 own{placed.row[0][i], placed.row[1][i], placed.row[2][i]};
    if (length(own) > 0) gizmo.axes[static_cast<std::size_t>(i)] = normalize(own);
  }
  return gizmo;
}

std::vector<Vec3> handleLine(const Gizmo& gizmo, int handle) {
  const auto ring = [&](const Vec3& axis, Real radius) {
    std::vector<Vec3> line;
    const Vec3 side = perpendicularTo(axis), other = cross(axis, side);
    for (int i = 0; i <= kRing; ++i) {
      const Real angle = 2 * kPi * i / kRing;
      line.push_back(gizmo.center + (side * math::cos(angle) + other * math::sin(angle)) * radius);
    }
    return line;
  };
  if (handle == Gizmo::kWhole) {
    const Real r = 0.1 * gizmo.size;
    return {gizmo.center - Vec3{r, 0, 0}, gizmo.center + Vec3{r, 0, 0}, gizmo.center,
            gizmo.center - Vec3{0, r, 0}, gizmo.center + Vec3{0, r, 0}, gizmo.center,
            gizmo.center - Vec3{0, 0, r}, gizmo.center + Vec3{0, 0, r}};
  }
  const Vec3& axis = gizmo.axes[static_cast<std::size_t>(handle)];
  if (gizmo.mode == GizmoMode::turn) return ring(axis, gizmo.size);
  return {gizmo.center + axis * (0.2 * gizmo.size), gizmo.center + axis * gizmo.size};
}

int handleAt(const Gizmo& gizmo, const CameraFrame& view, const Vec2& place, Real reach) {
  const Vec2 at = onScreen(view, place);
  int nearest = -1;
  Real least = reach;
  for (int handle = 0; handle < Gizmo::kHandles; ++handle) {
    std::optional<Vec2> last;
    for (const Vec3& point : handleLine(gizmo, handle)) {
      const std::optional<Vec2> here = seen(view, point);
      if (last && here)
        if (const Real distance = distanceTo(at, *last, *here); distance < least) {
          least = distance;
          nearest = handle;
        }
      last = here;
    }
  }
  return nearest;
}

std::optional<Affine> draggedBy(const Gizmo& gizmo, int handle, const CameraFrame& view, const Vec2& from,
                                const Vec2& to) {
  switch (gizmo.mode) {
    case GizmoMode::move: return moved(gizmo, handle, view, from, to);
    case GizmoMode::turn: return turnedBy(gizmo, handle, view, from, to);
    case GizmoMode::scale: return scaled(gizmo, handle, view, from, to);
  }
  return {};
}

}  // namespace trace
