// What lint asks of a scene by tracing rays: what is inside what, and what a sparse picture sees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "image/picture.h"
#include "render/ray_tree.h"
#include "render/world.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

/// The objects that enclose the point on all sides: a ray from it crosses each an odd number of times, in
/// every one of many directions. So an open surface encloses nothing.
std::vector<std::uint32_t> objectsAround(const World& world, const Vec3& point);

/// The object closes off what is around the point: the one crossing that a ray from there has with it is the
/// last with anything; so in half of many directions or more, and in the others it is not met. Spheres and
/// boxes that enclose the point do, and so do domes, and planes without end.
bool isShell(const World& world, std::uint32_t object, const Vec3& point);

/// The most light that arrives at anything around the point where the light stands.
Real strongestAround(const World& world, const Light& light, const Vec3& position);

/// Something is in the cone of the light, near or far.
bool shinesOnSomething(const World& world, const SpotLight& light);

/// The share of a mesh's faces whose front looks to the inside of the mesh: seen from there, the ray comes
/// through an odd number of the mesh's surfaces. 0 for open surfaces.
double shareInsideOut(const World& world, std::uint32_t object, const MeshData& mesh);

/// A sparse picture of the scene, and what its rays met.
struct Survey {
  struct Seen {
    int places = 0;                          ///< where a ray that counts in the picture met the object
    int lit = 0;                             ///< of them: something other than black comes back
    int direct = 0;                          ///< of them: light comes straight from a source
    int couldBeLit = 0;                      ///< of them: the material scatters light
    int facesAway = 0;                       ///< pairs of a place and a light behind the surface there
    int outOfCone = 0;                       ///< pairs of a place and a spot light that shines elsewhere
    std::map<std::uint32_t, int> blockedBy;  ///< pairs of a place and a light, by what is between
    int sent = 0;                            ///< mirrored and refracted rays that went on from it
    int leftScene = 0;                       ///< of them: met nothing, where a background would be seen
    int mirroredAway = 0;                    ///< of these: mirrored
  };
  struct Lamp {
    int places = 0;      ///< that scatter light and that it would shine on, were nothing in the way
    Real strongest = 0;  ///< of what arrives there, or at what stands around the light
    std::map<std::uint32_t, int> reached;  ///< shadow rays that arrived, by where they came from
    /// Shadow rays that did not arrive, by where they came from and what is between.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> blocked;
    int reachedOthers = 0;    ///< places on what is no glass itself
    int throughGlass = 0;     ///< of them: through something that refracts
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
