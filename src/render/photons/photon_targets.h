// Where photons are sent: to balls around what mirrors or refracts, so that none is lost (the projection map
// of Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, section 5.3), or to all of the scene.
#pragma once

#include <optional>
#include <vector>

#include "render/world/world.h"

namespace trace {

/// A ball around an object that mirrors or refracts.
struct PhotonTarget {
  Vec3 center;
  Real radius;
};
/// If photons `follow` lobes, of what mirrors or refracts into one direction only.
std::vector<PhotonTarget> photonTargetsOf(const World& world, const Settings& settings, bool follow);

/// A photon on its way to a target.
struct PhotonAim {
  Ray ray;
  /// The solid angle, or of parallel light the area, for which it stands when all of the light's photons are
  /// one.
  Real share;
};

/// Where photons of a light start that is at a place: toward one of the targets, evenly over the solid angle
/// that they cover.
std::optional<PhotonAim> aimFrom(const Vec3& place, const std::vector<PhotonTarget>& targets, Real which,
                                 const Vec2& u);

/// A start of parallel light: evenly over the disks that the targets cover.
std::optional<PhotonAim> aimAlong(const Vec3& direction, const std::vector<PhotonTarget>& targets,
                                  const Box3& scene, Real which, const Vec2& u);

}  // namespace trace
