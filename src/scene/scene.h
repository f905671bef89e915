// A scene: what a file said and what a person edits. Plain values, copied, compared, saved.
//
// Nested transforms are multiplied out. A group that is used many times is kept once, with its placements
// (scene/groups.h). compile() (render/world/world.h) makes from it the World that rays hit, out of the same
// shape, material and light structs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "geometry/shape.h"
#include "math/transform.h"
#include "scene/input_files.h"
#include "scene/options.h"
#include "scene/surroundings.h"
#include "shading/background.h"
#include "shading/cameras/camera.h"
#include "shading/lights/light.h"
#include "shading/lights/light_links.h"
#include "shading/material.h"

namespace trace {

struct Object {
  std::string name;  ///< as in the file; may be empty
  Shape shape;
  Affine worldFromObject;
  std::uint32_t material = 0;  ///< index into Scene::materials
  SourcePlace place;           ///< where the file defines it
  ObjectLinks links{};
  bool operator==(const Object&) const = default;
};

/// One placement of a group: an instance.
struct GroupUse {
  Affine outFromGroup;
  std::uint32_t place = 0;  ///< index into Scene::usePlaces
  bool operator==(const GroupUse&) const = default;
};

/// All placements of one group in the scene, or in another group. Copies of a scene share them.
struct GroupUses {
  using List = std::vector<GroupUse>;

  std::uint32_t group = 0;  ///< index into Scene::groups
  std::shared_ptr<const List> list = std::make_shared<const List>();
  bool operator==(const GroupUses& other) const {
    return group == other.group && (list == other.list || *list == *other.list);
  }
};

/// Objects that are placed together, many times.
struct Group {
  std::string name;  ///< as in the file; may be empty
  SourcePlace place{};
  std::vector<Object> objects{};  ///< in the space of the group
  std::vector<GroupUses> uses{};  ///< placements of groups before this one
  bool operator==(const Group&) const = default;
};

struct LightSource {
  Light light;
  SourcePlace place;
  LightLinks links{};
  bool operator==(const LightSource&) const = default;
};

/// Something the file says that Trace understands or skips but does not render: kept as it stands in the
/// file, so that writing the scene loses nothing.
struct Unrendered {
  std::string kind;  ///< the keyword: "warn_light", "map", "texture_uv", ...
  SourcePlace place;
  std::string text;  ///< the source text of the node
  bool operator==(const Unrendered&) const = default;
};

/// A material that the file names and gives to nothing.
struct UnusedMaterial {
  std::string name;
  SourcePlace place;
  bool operator==(const UnusedMaterial&) const = default;
};

/// The shape of a picture that the file leaves open. A picture of which both sides are given then has another
/// camera, rather than pixels that are not square.
struct FreeAspect {
  enum class Keeps { upward, across, both };  ///< which angle of the camera; `both`: neither gets smaller
  Real chosen = 0;                            ///< the camera's aspectratio by default; 0: the file gives it
  Keeps keeps = Keeps::upward;
  bool operator==(const FreeAspect&) const = default;
};

/// Copied and compared in one .cpp: it is slow to compile.
struct Scene {
  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();
  bool operator==(const Scene&) const;

  std::string file;
  std::string format;   ///< name of the format it was read from
  std::string picture;  ///< where a render goes that names no file; empty: the scene's name in this folder
  Camera camera;
  FreeAspect freeAspect;
  Background background;
  std::vector<LightSource> lights;
  std::vector<Material> materials;
  std::vector<Object> objects;  ///< those that are no part of a group
  std::vector<Group> groups;
  std::vector<GroupUses> uses;         ///< placements of groups
  std::vector<SourcePlace> usePlaces;  ///< where the file places them
  std::vector<Choice> choices;         ///< options that the file sets, or that follow from its dialect
  std::vector<Unrendered> unrendered;
  std::vector<UnusedMaterial> unusedMaterials;
  /// The choices that the file left to Trace, in words: "a camera that shows all objects"
  /// (formats/kind_defaults.h).
  std::vector<std::string> kindDefaults;
  InputFiles inputs;  ///< what it was read from
  Surroundings surroundings;
};

/// Changes every picture that the scene puts on surfaces and around itself: change(Pixels&).
template <class Change>
void changePixels(Scene& scene, const Change& change) {
  for (Material& material : scene.materials) changePixels(material, change);
  for (LightSource& source : scene.lights) changePixels(source.light, change);
  changePixels(scene.background, change);
}

}  // namespace trace
