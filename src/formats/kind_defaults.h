// The kind defaults: what a scene gets that leaves things to Trace, so that its first picture is worth
// looking at (docs/trace-1.md). They hold in files that begin with `Trace 1` and for meshes rendered by
// themselves. All of them are plain values of the Scene: written in another format, it looks the same.
//
// Scenes of the courses never come here.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace trace {

/// What the file said, as far as defaults depend on it.
struct KindGiven {
  bool cameraPosition = false, cameraDirection = false;
  std::optional<Vec3> lookAt{};
  bool aspect = false;
  /// Lights, by their numbers, of which nothing says how they fade.
  std::vector<std::size_t> fading{};
};

/// Completes the scene. `place` is where the file says its kind; the choices of options carry it.
void addKindDefaults(Scene& scene, const KindGiven& given, const Place& place);

/// Completes the scene of a file of meshes; the camera and the lights of sceneOf() (formats/model.h), where
/// the file has none, give way to better ones.
void completeModel(Scene& scene, bool hasCamera, bool hasLights);

/// Meshes without normals look round where their faces meet at less than 40 degrees, if the scene is a file
/// of meshes by itself: for a render of it, since a conversion keeps the points that there are.
void smoothBareMeshes(Scene& scene);

/// What shines on a mesh that has no light of its own: one light from the left above the camera.
std::vector<LightSource> keyLights(const Camera& camera);

/// The bounds of what a person looks at: of all objects that end somewhere, but for a floor that is much
/// larger than all that stands on it.
Box3 boundsOfInterest(const Scene& scene);

}  // namespace trace
