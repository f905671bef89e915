// The check of glass objects inside and across one another.
#include <algorithm>
#include <optional>
#include <utility>

#include "app/lint/checks.h"
#include "base/budget.h"
#include "geometry/shapes/solids/placed.h"

namespace trace::lint_checks {
namespace {

/// A body that light passes.
struct Body {
  std::uint32_t object;
  Box3 bounds;
  Real index;
};

bool meet(const Box3& a, const Box3& b) {
  const Vec3 low = max(a.low, b.low), high = min(a.high, b.high);
  return low.x < high.x && low.y < high.y && low.z < high.z;
}

std::vector<Body> bodiesOf(const LintScene& s) {
  std::vector<Body> bodies;
  for (std::uint32_t i = 0; i < s.scene.objects.size(); ++i) {
    if (s.world.opaque(i) || !s.world.solid(i)) continue;
    const Object& object = s.scene.objects[i];
    const Box3 bounds = placedBounds(check(object.shape).bounds, object.worldFromObject);
    if (!bounds.empty() && !bounds.unbounded()) bodies.push_back({i, bounds, materialOf(s, i).index});
  }
  return bodies;
}

/// The body that the ray enters first while it is inside another that bends light, and that other.
std::optional<std::pair<std::uint32_t, std::uint32_t>> nested(const LintScene& s, const Ray& ray, Real tMost,
                                                              const std::vector<Body>& bodies) {
  std::vector<Found> all;
  Statistics uncounted;
  s.world.crossings(ray, tMost, Faces::both, uncounted, [&](const Found& found) {
    if (!s.world.opaque(found.object) && s.world.solid(found.object)) all.push_back(found);
    return false;
  });
  std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.before(b); });
  const auto bends = [&](std::uint32_t object) {
    const auto body =
        std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.object == object; });
    return body != bodies.end() && std::abs(body->index - s.settings.airIndex) > 0.01;
  };
  std::vector<std::pair<std::uint32_t, Real>> inside;  // and where it was entered
  for (const Found& found : all) {
    const auto same = std::find_if(inside.begin(), inside.end(),
                                   [&](const auto& body) { return body.first == found.object; });
    if (same == inside.end()) {
      inside.emplace_back(found.object, found.t);
      continue;
    }
    // Bodies that only touch, or that rounding lets overlap, are not meant.
    for (const auto& [other, entered] : inside)
      if (other != found.object && bends(other) && found.t - std::max(entered, same->second) > 1e-6 * tMost)
        return std::pair{found.object, other};
    inside.erase(same);
  }
  return {};
}

}  // namespace

void glassInGlass(const LintScene& s, Findings& findings) {
  constexpr int kSide = 8;  // side of the grid of rays through each body
  if (s.world.nestedGlass()) return;
  const std::vector<Body> bodies = bodiesOf(s);
  for (const Body& body : bodies) {
    checkBudget();
    if (std::none_of(bodies.begin(), bodies.end(), [&](const Body& other) {
          return other.object != body.object && meet(body.bounds, other.bounds);
        }))
      continue;
    const Vec3 size = body.bounds.size();
    const Real far = length(size);
    for (int k = 0; k < kSide * kSide; ++k) {
      const Vec3 through = body.bounds.low + Vec3{size.x * (k % kSide + 0.5) / kSide,
                                                  size.y * (Real(k) / kSide + 0.5) / kSide, size.z / 2};
      const Vec3 direction = normalize(Vec3{0.13, 0.17, 1});
      const auto pair = nested(s, {through - direction * (2 * far), direction}, 4 * far, bodies);
      if (!pair) continue;
      const auto [inner, outer] = *pair;
      return warn(findings, "glass-in-glass", placeOf(s, inner),
                  quoted(s, inner) + " is inside " + quoted(s, outer) +
                      " or across it, and each glass object is assumed to be in air: light is refracted "
                      "wrongly where they meet",
                  "give the materials a `priority`, or use --nested-glass on");
    }
  }
}

}  // namespace trace::lint_checks
