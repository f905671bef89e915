#include "render/tracer.h"

#include <algorithm>

namespace trace {

Faces Tracer::facesSeenBy(RayKind kind) const {
  const bool seen = kind == RayKind::camera || kind == RayKind::reflection;
  if (settings_.backFaces == BackFaces::cullAll) return Faces::front;
  return settings_.backFaces == BackFaces::cullSeen && seen ? Faces::shadedFront : Faces::both;
}

std::optional<Hit> Tracer::cast(const Ray& ray, RayKind kind) {
  ++statistics_.rays[static_cast<std::size_t>(kind)];
  const auto found = world_.closest(ray, facesSeenBy(kind), statistics_);
  if (!found) return {};
  Hit hit{found->t, found->object, world_.surface(ray, *found), world_.material(*found), false};
  hit.leaving = dot(ray.direction, hit.surface.normal) > 0;
  return hit;
}

Color Tracer::visible(const SurfacePoint& from, const Vec3& toLight, Real distance) {
  ++statistics_.rays[static_cast<std::size_t>(RayKind::shadow)];
  const Ray ray = spawnRay(from, toLight);
  bool blocked = false;
  crossed_.clear();
  world_.crossings(ray, distance, facesSeenBy(RayKind::shadow), statistics_, [&](const Found& found) {
    blocked = world_.opaque(found.object);
    if (!blocked) crossed_.push_back(found);
    return blocked;
  });
  if (blocked) return Color(0);

  // In order along the ray, so that the product's last bit does not depend on the hierarchy; each once.
  std::sort(crossed_.begin(), crossed_.end(), [](const Found& a, const Found& b) { return a.before(b); });
  const auto same = [](const Found& a, const Found& b) { return !a.before(b) && !b.before(a); };
  crossed_.erase(std::unique(crossed_.begin(), crossed_.end(), same), crossed_.end());
  Color passed(1);
  Real last = 0;
  for (const Found& found : crossed_) {
    const Color filter = world_.material(found).transmissive;
    if (isBlack(filter)) return Color(0);
    if (settings_.glass == Glass::perCrossing)
      passed *= filter;
    else if (dot(toLight, world_.surface(ray, found).normal) > 0)
      passed *= pow(filter, found.t - last);
    last = found.t;
  }
  return passed;
}

}  // namespace trace
