#include "render/samples/outline.h"

#include <cmath>

#include "math/elementary.h"

namespace trace {
namespace {

constexpr int kRays = 16;          // around a sample
constexpr Real kEdge = 0.8660254;  // the cosine of 30 degrees: a surface that turns by more has an edge

/// The ray hits something else than what was hit, or a part of it behind an edge.
bool elsewhere(Tracer& tracer, const std::optional<Hit>& hit, const Ray& ray) {
  const World& world = tracer.world();
  const std::optional<Found> found = tracer.look(ray, RayKind::camera);
  const bool seen = found && world.camera().sees(found->t);
  if (!seen || !hit) return seen != hit.has_value();
  if (found->object != hit->object) return true;
  const SurfacePoint there = world.surface(ray, *found);
  if (dot(there.shading, hit->surface.shading) < kEdge) return true;
  const Vec3 way = there.point - hit->surface.point;  // steeper against the surface than any edge: a step
  return std::abs(dot(way, hit->surface.shading)) > length(way) * std::sqrt(1 - kEdge * kEdge);
}

}  // namespace

Real inkAt(Tracer& tracer, const std::optional<Hit>& hit, const Vec2& film, const Vec2& lens,
           const Size& size) {
  const Real radius = tracer.settings().outlines / 2;
  int others = 0;
  for (int i = 0; i < kRays; ++i) {
    const math::SinCos angle = math::sincos(2 * kPi * (i + 0.5) / kRays);
    const Vec2 place{film.x + radius * angle.cos / size.width, film.y + radius * angle.sin / size.height};
    others += elsewhere(tracer, hit, tracer.world().camera().ray(place, lens));
  }
  return min(1, 2.0 * others / kRays);  // half of them lie on the other side of a straight edge
}

}  // namespace trace
