// What lint asks of a scene by tracing rays: what is inside what, and what a sparse picture sees.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "render/ray_tree.h"
#include "render/world.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

/// The objects that enclose the point on all sides: a ray from it crosses each an odd number of times, in
/// every one of many directions. So an open surface encloses nothing.
std::vector<std::uint32_t> objectsAround(const World& world, const Vec3& point);

/// Of a mesh, the share of its faces whose front looks to the inside of the mesh: seen from there, the ray
/// comes through an odd number of the mesh's surfaces. 0 for open surfaces.
double shareInsideOut(const World& world, std::uint32_t object, const MeshData& mesh);

/// A sparse picture of the scene, and what its rays met.
struct Survey {
  struct Seen {
    int places = 0;                          ///< where a ray that counts in the picture met the object
    int lit = 0;                             ///< of them: something other than black comes back
    int direct = 0;                          ///< of them: light comes straight from a source
    int couldBeLit = 0;                      ///< of them: the material scatters light
    int facesAway = 0;                       ///< pairs of a place and a light behind the surface there
    std::map<std::uint32_t, int> blockedBy;  ///< pairs of a place and a light, by what is between
  };
  struct Lamp {
    int reached = 0;          ///< shadow rays that arrived
    int throughGlass = 0;     ///< of them: through something that refracts
    std::uint32_t glass = 0;  ///< the first of these
  };
  std::vector<Seen> objects;  ///< like Scene::objects
  std::vector<Lamp> lights;   ///< like Scene::lights
  int samples = 0;
  int cutShort = 0;  ///< samples of which a refracted ray that counts was not sent for the depth limit
  std::uint32_t cutShortIn = 0;  ///< the object where that happened first
  std::map<std::pair<std::uint32_t, std::uint32_t>, int>
      coplanar;  ///< places where two objects' faces are one
};
Survey survey(const Scene& scene, const Settings& settings, const World& world);

/// The share of the samples that the depth limit cuts short, if the limit were `depth`.
double shareCutShort(const Settings& settings, const World& world, int depth);

}  // namespace trace
