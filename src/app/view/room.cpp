#include "app/view/room.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "math/elementary.h"
#include "render/world/hit.h"

namespace trace {
namespace {

constexpr int kRoomDirections = 400;
constexpr int kLeastMet =
    kRoomDirections * 3 / 4;  // that hit something in a room; the rest may be doors and windows

/// Spread evenly over the sphere: the golden angle apart, in bands of equal area (Gonzalez, "Measurement of
/// areas on a sphere using Fibonacci and latitude-longitude lattices", 2010).
Vec3 lookAlong(int i) {
  const Real golden = kPi * (3 - std::sqrt(5.0));
  const Real y = 1 - (2 * i + 1.0) / kRoomDirections, r = std::sqrt(1 - y * y), angle = golden * i;
  return {r * math::cos(angle), y, r * math::sin(angle)};
}

}  // namespace

std::vector<std::uint32_t> wallsAround(const World& world, const Vec3& inside, const Box3& frame) {
  if (frame.empty() || !isFinite(frame.size())) return {};
  const Real far = length(frame.size()) + length(frame.center() - inside);
  if (!std::isfinite(far)) return {};
  std::set<std::uint32_t> walls;
  int met = 0;
  Statistics statistics;
  for (int i = 0; i < kRoomDirections; ++i) {
    const Vec3 out = lookAlong(i);
    const auto found = world.closest({inside + out * far, -out}, Faces::both, statistics);
    if (!found || found->t >= far) continue;
    walls.insert(found->object);
    ++met;
  }
  if (met < kLeastMet) return {};
  return {walls.begin(), walls.end()};
}

std::optional<Found> closestShown(const World& world, const Ray& ray, const std::vector<std::uint32_t>& walls,
                                  const Vec3& inside) {
  Statistics statistics;
  if (walls.empty()) return world.closest(ray, Faces::both, statistics);
  std::optional<Found> nearest;
  world.crossings(ray, kInfinity, Faces::both, statistics, [&](const Found& found) {
    if (nearest && !found.before(*nearest)) return false;
    if (std::binary_search(walls.begin(), walls.end(), found.object)) {
      const SurfacePoint surface = Hit(world, ray, found).surface;
      if (parts(surface.normal, surface.point, ray.origin, inside)) return false;
    }
    nearest = found;
    return false;
  });
  return nearest;
}

}  // namespace trace
