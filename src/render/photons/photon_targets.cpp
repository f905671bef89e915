#include "render/photons/photon_targets.h"

#include <algorithm>

#include "math/warp.h"

namespace trace {
namespace {

/// One of the targets, by how much each covers, and what all cover.
struct TargetChoice {
  const PhotonTarget& target;
  Real all;
};
template <class Covers>
TargetChoice chosenTarget(const std::vector<PhotonTarget>& targets, Real which, const Covers& covers) {
  Real all = 0;
  for (const PhotonTarget& t : targets) all += covers(t);
  Real rest = which * all;
  for (const PhotonTarget& t : targets)
    if ((rest -= covers(t)) < 0) return {t, all};
  return {targets.back(), all};
}

}  // namespace

std::vector<PhotonTarget> photonTargetsOf(const World& world, const Settings& settings, bool follow) {
  constexpr std::size_t kMost = 64;
  std::vector<PhotonTarget> targets;
  Box3 all;
  const auto add = [&](const Box3& box) { targets.push_back({box.center(), length(box.size()) / 2}); };
  for (std::uint32_t object = 0; object < world.objectCount(); ++object) {
    const Box3 box = world.boundsOf(object);
    if (box.empty() || box.unbounded() || !world.sendsOn(object, settings.varnish, follow)) continue;
    add(box);
    all.extend(box);
  }
  if (const Box3 placed = world.placedThatSendOn(settings.varnish, follow); !placed.empty()) {
    add(placed);
    all.extend(placed);
  }
  if (targets.size() > kMost) {
    targets.clear();
    add(all);
  }
  return targets;
}

std::optional<PhotonAim> aimFrom(const Vec3& place, const std::vector<PhotonTarget>& targets, Real which,
                                 const Vec2& u) {
  const auto cosineOf = [&](const PhotonTarget& t) {
    const Vec3 way = t.center - place;
    const Real sine2 = t.radius * t.radius / dot(way, way);
    return sine2 < 1 ? std::sqrt(1 - sine2) : -1;  // from inside it is all around
  };
  const auto [chosen, all] =
      chosenTarget(targets, which, [&](const PhotonTarget& t) { return 1 - cosineOf(t); });
  const Vec3 way = chosen.center - place;
  const Vec3 direction = toCone(u, length(way) > 0 ? normalize(way) : Vec3{0, 0, 1}, cosineOf(chosen));
  const auto covers = [&](const PhotonTarget& t) {
    const Vec3 to = t.center - place;
    return dot(to, direction) >= cosineOf(t) * length(to);
  };
  const auto over = std::count_if(targets.begin(), targets.end(), covers);
  if (over == 0) return {};  // rounding at its rim
  return PhotonAim{{place, direction}, 2 * kPi * all / static_cast<Real>(over)};
}

std::optional<PhotonAim> aimAlong(const Vec3& direction, const std::vector<PhotonTarget>& targets,
                                  const Box3& scene, Real which, const Vec2& u) {
  const auto [chosen, all] =
      chosenTarget(targets, which, [](const PhotonTarget& t) { return t.radius * t.radius; });
  const Vec3 x = perpendicularTo(direction), y = cross(direction, x);
  const Vec2 disk = toDisk(u);
  const Vec3 place = chosen.center + (x * disk.x + y * disk.y) * chosen.radius;
  const auto covers = [&](const PhotonTarget& t) {
    const Vec3 off = cross(place - t.center, direction);
    return dot(off, off) <= t.radius * t.radius;
  };
  const auto over = std::count_if(targets.begin(), targets.end(), covers);
  if (over == 0) return {};
  const Real before = 2 * length(scene.size());
  return PhotonAim{{place - direction * before, direction}, kPi * all / static_cast<Real>(over)};
}

}  // namespace trace
