// Statistics that lint takes from a coarse picture of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "image/picture.h"
#include "render/rays/ray_tree.h"
#include "render/world/world.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

/// A sparse picture of the scene, and what its rays met.
struct Survey {
  struct Seen {
    int places = 0;                          ///< where a ray that counts in the picture met the object
    int lit = 0;                             ///< number of those from which anything but black returns
    int direct = 0;                          ///< number of those with direct light
    int couldBeLit = 0;                      ///< number of those whose material scatters light
    int facesAway = 0;                       ///< pairs of a place and a light behind the surface there
    int unlinked = 0;                        ///< pairs of a place and a light that links keep off the object
    int outOfCone = 0;                       ///< pairs of a place and a spot light that shines elsewhere
    std::map<std::uint32_t, int> blockedBy;  ///< pairs of a place and a light, by what is between
    int sent = 0;                            ///< mirrored and refracted rays that continued from it
    int leftScene = 0;     ///< number of those that hit nothing, where a background would be seen
    int mirroredAway = 0;  ///< number of those that were mirrored
  };
  struct Lamp {
    int places = 0;      ///< that scatter light and that it would shine on, were nothing in the way
    Real strongest = 0;  ///< strongest of what arrives there, or at what stands around the light
    std::map<std::uint32_t, int> reached;  ///< shadow rays that arrived, by where they came from
    /// Shadow rays that did not arrive, by where they came from and what is between.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> blocked;
    int reachedOthers = 0;    ///< places on what is no glass itself
    int throughGlass = 0;     ///< number of those that passed a refracting object
    std::uint32_t glass = 0;  ///< the first of these
  };
  std::vector<Seen> objects;  ///< like Scene::objects
  std::vector<Lamp> lights;   ///< like Scene::lights
  int samples = 0;
  int met = 0;     ///< samples that met something
  int cutOff = 0;  ///< samples that met something where the camera does not see
  Picture picture;
  /// Pixels of which a refracted ray that counts was not sent for the depth limit.
  std::vector<std::size_t> cutShort;
  std::uint32_t cutShortIn = 0;  ///< the object where that happened first
  std::map<std::pair<std::uint32_t, std::uint32_t>, int>
      coplanar;  ///< places where two objects' faces are one
};
Survey survey(const Scene& scene, const Settings& settings, const World& world);

/// How many of the pixels that the depth limit cuts short look different from what they are with as much
/// depth as they need: with the depth set (the first), with one more, and so on to that depth. Rays that may
/// be followed are bounded, so that depth may be smaller than needed.
std::vector<int> changedByDepth(const Settings& settings, const World& world, const Survey& survey);

}  // namespace trace
