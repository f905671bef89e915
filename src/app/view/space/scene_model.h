// A scene as triangles, for the interactive view.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/session/background_task.h"
#include "base/error.h"
#include "geometry/mesh/tessellate.h"
#include "math/box.h"
#include "render/world/world.h"
#include "scene/scene.h"

namespace trace {

/// A part of an object that has one material.
struct ScenePart {
  static constexpr std::uint32_t kCopy = 0xffffffffu;

  std::uint32_t object = 0;                ///< index into Scene::objects; kCopy of one in a placed group
  Color color;                             ///< what it looks like in white light
  Real opacity = 1;                        ///< less of what transmits light
  std::size_t first = 0, count = 0;        ///< first and count of SceneModel::corners
  std::size_t fewFirst = 0, fewCount = 0;  ///< the same of fewer triangles, in SharedCorners::indices only
  std::array<Vec3, 8> box;  ///< box of the object's own bounds, in the world: bits of the index are x, y, z
};

/// Corners that are the same, once each.
struct SharedCorners {
  std::vector<float> corners;          ///< position and normal, six floats for each
  std::vector<std::uint32_t> indices;  ///< the one that each of the given corners is; then those of others
};
SharedCorners sharedCorners(const std::vector<float>& corners);

struct SceneModel {
  /// Coordinates in float are (world - origin) / scale.
  Vec3 origin;
  Real scale = 1;
  /// Position and normal, six floats for each corner of a triangle.
  std::vector<float> corners;
  /// Corners as a graphics card wants them, which is slow by corners; and fewer triangles, about
  /// kFewTriangles, for frames that must not be late.
  SharedCorners shared;
  static constexpr std::size_t kFewTriangles = 16000;
  std::vector<ScenePart> parts;
  /// Sharp edges of what transmits light, both ends of each: else flat glass would hardly be seen.
  std::vector<std::array<std::array<float, 3>, 2>> creases;
  std::vector<Message> warnings;  ///< warnings of shapes that are drawn coarser than others, or not at all

  std::array<float, 3> local(const Vec3& world) const {
    const Vec3 p = (world - origin) / scale;
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
};

/// The look of a material in white light: the mean colour of its texture, and 1 less what it transmits.
struct MaterialLook {
  Color color;
  Real opacity = 1;
};
MaterialLook lookOf(const Material& material);

/// Around the objects that have an end and the camera, except for those so far out that the others would be a
/// dot beside them. Empty if there are none.
Box3 frameOf(const Scene& scene);

/// Makes models of a scene that is edited, and keeps the triangles of shapes that stay as they are.
class SceneModeler {
 public:
  /// Models all objects. It leaves out those whose transform cannot be undone, as a render does, and those
  /// that frameOf() leaves out. Infinite objects are cut off some way around the others and the camera.
  /// `cancelled`, if any, is asked after every object; then the rest is left out. `fineness`: curved surfaces
  /// get so many times as many triangles along a side.
  SceneModel model(const Scene& scene, const Cancelled& cancelled = {}, double fineness = 1);

 private:
  using Corners = std::shared_ptr<const std::vector<SurfaceCorner>>;
  struct Made {
    Shape shape;
    Corners corners;
    int divisions;  ///< that the surface was followed in
  };

  Made made(const Shape& shape, const Box3& within, std::vector<Made>& kept) const;

  std::vector<Made> made_;  // the shapes of the last model, each once
  double fineness_ = 1;     // that they were made with
};

/// The target of the camera: a box around most of the points in the middle of its picture, those well outside
/// the frame left out. Empty if it sees nothing.
Box3 seenBy(const World& world, const Box3& frame);

/// Whether a modeler would make the same model.
bool sameModel(const Scene& a, const Scene& b);

}  // namespace trace
