// The check of portals: whether the sky comes through them, to places that do not see it past them.
#include <algorithm>
#include <optional>
#include <vector>

#include "app/lint/checks.h"
#include "math/low_discrepancy.h"
#include "math/warp.h"
#include "render/world/hit.h"
#include "shading/lights/panel.h"
#include "shading/lights/portal.h"

namespace trace::lint_checks {
namespace {

constexpr int kLines = 256;           ///< through a portal
constexpr int kLooks = 8;             ///< at the sky, from each place that they end at
constexpr double kMuchPastIt = 0.45;  ///< fraction of these rays; under an open sky a wall sees a half

struct PortalLook {
  int toSky = 0;  ///< lines of which an end leaves the scene
  int looks = 0,
      past = 0;  ///< numbers of points at their other ends: all, and those that see the sky past portals
};

/// The first opaque thing on the ray; what transmits light or has holes is none.
std::optional<Found> firstOpaque(const World& world, const Ray& ray) {
  for (const Found& found : allCrossings(world, ray, kInfinity))
    if (world.opaque(found.object)) return found;
  return {};
}

bool leaves(const World& world, const Ray& ray) { return !firstOpaque(world, ray); }

bool isThroughPortal(const World& world, const Ray& ray) {
  return std::any_of(world.portals().begin(), world.portals().end(),
                     [&](const LightGeometry& portal) { return meetsPanel(portal, ray).has_value(); });
}

void lookFrom(const World& world, const Ray& ray, const Found& found, std::uint64_t seed, PortalLook& look) {
  const Hit hit(world, ray, found);
  const Vec3 normal = hit.surface.normal * (dot(hit.surface.normal, ray.direction) > 0 ? -1.0 : 1.0);
  for (std::uint32_t i = 0; i < kLooks; ++i) {
    const Ray up = hit.leave(toCone(sobolPoint(i, seed), normal, 0));
    ++look.looks;
    look.past += leaves(world, up) && !isThroughPortal(world, up);
  }
}

/// Lines that cross the portal, and what is at their ends.
PortalLook lookThrough(const World& world, const Portal& portal) {
  PortalLook look;
  const Vec3 across = normalize(cross(portal.u, portal.v));
  for (std::uint32_t i = 0; i < kLines; ++i) {
    const Vec3 at = placeOn(portal, sobolPoint(i, 1));
    const Vec3 along = toCone(sobolPoint(i, 2), across, 0);
    const Ray ends[] = {{at, along}, {at, -along}};
    const std::optional<Found> met[] = {firstOpaque(world, ends[0]), firstOpaque(world, ends[1])};
    if (met[0] && met[1]) continue;
    ++look.toSky;
    for (const int end : {0, 1})
      if (met[end]) lookFrom(world, ends[end], *met[end], i, look);
    if (met[0] || met[1]) continue;
    look.looks += kLooks;  // nothing is there, and the sky on both sides
    if (!isThroughPortal(world, ends[0]) && !isThroughPortal(world, ends[1])) look.past += kLooks;
  }
  return look;
}

}  // namespace

void portalUseless(const LintScene& s, Findings& findings) {
  for (const LightSource& source : s.scene.lights) {
    const auto* portal = source.light.as<Portal>();
    if (!portal) continue;
    if (!s.world.outside().isSeenBy(RayKind::bounce)) {
      warn(findings, "portal", source.place, "the portal changes nothing: the environment is black",
           "give the scene a background or an environment; a light outside needs no portal");
      continue;
    }
    const PortalLook look = lookThrough(s.world, *portal);
    if (look.toSky == 0)
      warn(findings, "portal", source.place,
           "no light comes through the portal: something opaque is before and behind it everywhere",
           "a portal lies in the opening of a window, with the sky on one side of it");
    else if (look.past > kMuchPastIt * look.looks)
      warn(findings, "portal", source.place,
           "the portal stands in the open: points behind it see the sky past the portal",
           "move it into the opening of a room; without a room, the picture has less noise without a portal");
  }
}

}  // namespace trace::lint_checks
