// Facts of a scene that passes need and its World does not have: the names of objects, materials and groups
// of light, as numbers, and where things move.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/transform.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "shading/cameras/camera.h"

namespace trace {

/// Names of what the passes of a picture tell apart. Their numbers are places in these lists.
struct PassNames {
  /// Groups of light: the lights and emissive objects of one name, then `ambient`, `background` and `other`,
  /// which is light of no known source. Letters, digits, - and _ only, and no two alike.
  std::vector<std::string> groups;
  /// Each name once; those of objects without a name say where the file defines them.
  std::vector<std::string> objects, materials;

  bool empty() const { return groups.empty(); }
};
PassNames passNames(const Scene& scene);

/// Where the things of a moment are some time later, for the pass `motion`.
struct Motion {
  CameraFrame camera;                          ///< then
  std::vector<std::optional<Affine>> objects;  ///< world space then from world space now; none: it is gone
};

/// One moment's scene in the numbers of the names.
struct PassFacts {
  std::vector<std::uint32_t> lightGroups;   ///< groups of Scene::lights
  std::vector<std::uint32_t> objectGroups;  ///< groups of the emission of Scene::objects
  std::vector<std::uint32_t> objects;       ///< number of each name, from 1; 0: it has none
  std::vector<std::uint32_t> materials;     ///< likewise
  std::uint32_t ambient = 0, background = 0, other = 0;
  std::shared_ptr<const Motion> motion{};  ///< null: nothing moves
};
/// The scene may be another moment's than the one that the names are of.
PassFacts passFacts(const Scene& scene, const PassNames& names);

/// How the objects of a scene, and the camera, have moved in a later one. Objects are the same if they have
/// the same number and name. `camera` is that of the later scene.
Motion motionBetween(const Scene& now, const Scene& later, const CameraFrame& camera);

}  // namespace trace
