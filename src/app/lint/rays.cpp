#include "app/lint/rays.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/budget.h"
#include "geometry/mesh/mesh.h"
#include "image/development/tone.h"
#include "math/elementary.h"
#include "math/perpendicular.h"
#include "render/samples/pixel.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

constexpr int kDirections = 14;

/// Spread over the sphere (a Fibonacci spiral: Gonzalez 2010), none along an axis.
Vec3 direction(int i) {
  const Real z = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - z * z);
  const Real angle = i * kPi * (3 - std::sqrt(5.0)) + 0.1;
  return {r * math::cos(angle), r * math::sin(angle), z};
}

}  // namespace

std::vector<Found> allCrossings(const World& world, const Ray& ray, Real tMost) {
  std::vector<Found> found;
  Statistics uncounted;
  world.crossings(ray, tMost, Faces::both, uncounted, [&](const Found& f) {
    found.push_back(f);
    return false;
  });
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.before(b); });
  const auto same = [](const Found& a, const Found& b) { return !a.before(b) && !b.before(a); };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

std::vector<std::uint32_t> objectsAround(const World& world, const Vec3& point) {
  std::vector<int> odd(world.objectCount());
  for (int i = 0; i < kDirections; ++i) {
    std::map<std::uint32_t, int> crossed;
    for (const Found& found : allCrossings(world, {point, direction(i)}, kInfinity)) ++crossed[found.object];
    for (const auto& [object, times] : crossed) odd[object] += times % 2;
  }
  std::vector<std::uint32_t> around;
  for (std::uint32_t object = 0; object < odd.size(); ++object)
    if (odd[object] == kDirections) around.push_back(object);
  return around;
}

bool isShell(const World& world, std::uint32_t object, const Vec3& point) {
  int closed = 0;
  for (int i = 0; i < kDirections; ++i) {
    const std::vector<Found> crossed = allCrossings(world, {point, direction(i)}, kInfinity);
    const auto times = std::count_if(crossed.begin(), crossed.end(),
                                     [&](const Found& found) { return found.object == object; });
    if (times == 0) continue;
    if (times > 1 || crossed.back().object != object) return false;
    ++closed;
  }
  return 2 * closed >= kDirections;
}

Real strongestAround(const World& world, const Light& light, const Vec3& position) {
  Real strongest = 0;
  Statistics uncounted;
  const auto look = [&](const Vec3& direction) {
    const Ray ray{position, direction};
    const std::optional<Found> found = world.closest(ray, Faces::both, uncounted);
    if (!found) return;
    const Vec3 there = position + direction * found->t;
    if (const auto arriving = light.illuminate(there, world.rules()))
      strongest = std::max(strongest, maxComponent(arriving->intensity()));
  };
  for (int i = 0; i < kDirections; ++i) look(direction(i));
  if (isSpot(light)) look(normalize(*light.direction()));
  return strongest;
}

bool shinesOnSomething(const World& world, const LightGeometry& light) {
  constexpr int kRays = 200;
  const Vec3 axis = light.cone->axis, right = perpendicularTo(axis), up = cross(right, axis);
  const Real least = light.cone->cosine;
  Statistics uncounted;
  for (int i = 0; i < kRays; ++i) {  // spread over the cone as over a sphere
    const Real z = 1 - (1 - least) * i / kRays, r = std::sqrt(max(0, 1 - z * z));
    const Real angle = i * kPi * (3 - std::sqrt(5.0));
    const Ray ray{light.position, axis * z + right * (r * math::cos(angle)) + up * (r * math::sin(angle))};
    if (world.closest(ray, Faces::both, uncounted)) return true;
  }
  return false;
}

double shareInsideOut(const World& world, std::uint32_t object, const MeshData& mesh) {
  constexpr std::size_t kMost = 200;
  const std::size_t count = mesh.triangles.size(), step = std::max<std::size_t>(1, count / kMost);
  const Affine toWorld = world.worldFromObject(object);
  const Real far = 4 * length(world.bounds().size());
  int asked = 0, inside = 0;
  for (std::size_t i = 0; i < count; i += step) {
    const Corners c = corners(mesh, static_cast<std::uint32_t>(i));
    const Vec3 a = toWorld * c.a, center = a * 0.3 + (toWorld * c.b) * 0.37 + (toWorld * c.c) * 0.33;
    Vec3 normal = cross(toWorld * c.b - a, toWorld * c.c - a);
    if (normal == Vec3{} || !isFinite(normal)) continue;
    if (determinant(toWorld) < 0) normal = -normal;  // a mirror turns the corners round, not the surface
    normal = normalize(normal);
    int before = 0, all = 0;
    bool met = false;
    for (const Found& found : allCrossings(world, {center + normal * far, -normal}, kInfinity)) {
      if (found.object != object) continue;
      met = met || found.part == i;
      before += !met;
      ++all;
    }
    if (!met || all % 2 != 0) continue;  // an open surface has no inside
    ++asked;
    inside += before % 2;
  }
  return asked > 3 ? static_cast<double>(inside) / asked : 0;
}

}  // namespace trace
