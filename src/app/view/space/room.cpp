#include "app/view/space/room.h"

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

bool isShown(const World& world, const Ray& ray, const Found& found, const std::vector<std::uint32_t>& walls,
             const Vec3& inside) {
  if (!std::binary_search(walls.begin(), walls.end(), found.object)) return true;
  const SurfacePoint surface = Hit(world, ray, found).surface;
  return !parts(surface.normal, surface.point, ray.origin, inside);
}

/// So many of the points are seen from the eye.
std::size_t seenFrom(const Vec3& eye, const std::vector<Vec3>& points, const World& world,
                     const std::vector<std::uint32_t>& walls, const Vec3& inside) {
  constexpr Real kBehind = 0.999;  // share of the distance
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Vec3& point) {
    const Real distance = length(point - eye);
    if (!(distance > 0)) return true;
    const auto found = closestShown(world, {eye, (point - eye) / distance}, walls, inside);
    return !found || found->t >= kBehind * distance;
  }));
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

std::vector<Found> shownCrossings(const World& world, const Ray& ray, const std::vector<std::uint32_t>& walls,
                                  const Vec3& inside) {
  std::vector<Found> all;
  Statistics statistics;
  world.crossings(ray, kInfinity, Faces::both, statistics, [&](const Found& found) {
    if (isShown(world, ray, found, walls, inside)) all.push_back(found);
    return false;
  });
  std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.before(b); });
  return all;
}

std::optional<Found> closestShown(const World& world, const Ray& ray, const std::vector<std::uint32_t>& walls,
                                  const Vec3& inside) {
  Statistics statistics;
  if (walls.empty()) return world.closest(ray, Faces::both, statistics);
  std::optional<Found> nearest;
  world.crossings(ray, kInfinity, Faces::both, statistics, [&](const Found& found) {
    if (nearest && !found.before(*nearest)) return false;
    if (isShown(world, ray, found, walls, inside)) nearest = found;
    return false;
  });
  return nearest;
}

bool showsWell(const CameraFrame& view, const Box3& box, const std::vector<Vec3>& points) {
  constexpr Real kRim = 0.04, kLarge = 0.5;  // shares of the view
  for (const Vec3& point : points) {
    const auto at = view.placeOf(point);
    if (!at || at->x < kRim || at->y < kRim || at->x > 1 - kRim || at->y > 1 - kRim) return false;
  }
  Vec2 low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = view.placeOf({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                                  corner & 4 ? box.high.z : box.low.z});
    if (!at) return false;
    low = {std::min(low.x, at->x), std::min(low.y, at->y)};
    high = {std::max(high.x, at->x), std::max(high.y, at->y)};
  }
  return std::max(high.x - low.x, high.y - low.y) >= kLarge;
}

OrbitCamera inSight(const OrbitCamera& orbit, const std::vector<Vec3>& points, const World& world,
                    const std::vector<std::uint32_t>& walls, const Vec3& inside) {
  constexpr std::size_t kMostPoints = 40;
  std::vector<Vec3> some(points.begin(),
                         points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), kMostPoints)));
  OrbitCamera best = orbit;
  std::size_t most = seenFrom(orbit.frame(1).eye, some, world, walls, inside);
  for (const Real azimuth : {0.0, -0.4, 0.4, -0.8, 0.8, -1.5, 1.5, 2.3, 3.1})  // radians
    for (const Real elevation : {0.0, -0.3, -0.6, -1.2, 0.3}) {
      if (most == some.size()) return best;
      OrbitCamera turned = orbit;
      turned.turn(azimuth, elevation);
      const std::size_t seen = seenFrom(turned.frame(1).eye, some, world, walls, inside);
      if (seen <= most) continue;
      most = seen;
      best = turned;
    }
  return best;
}

}  // namespace trace
