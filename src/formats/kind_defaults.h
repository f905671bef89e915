// The kind defaults: what a scene gets that leaves things to Trace, so that its first picture is worth
// looking at (docs/trace-1.md). They hold in files that begin with `Trace 1` and for meshes rendered by
// themselves. All of them are plain values of the Scene: written in another format, it looks the same.
//
// Scenes of the courses never come here.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace trace {

/// width / height of a picture whose shape the file leaves to Trace.
inline constexpr Real kUsualAspect = 4.0 / 3;

/// The parts of a file on which defaults depend.
struct KindGiven {
  bool cameraPosition = false, cameraDirection = false;
  std::optional<Vec3> lookAt{};
  bool aspect = false, horizontalFov = false;
  /// Lights, by their numbers, of which nothing says how they fade.
  std::vector<std::size_t> fading{};
};

/// From this come the defaults of a scene that changes with time, so that they do not change with it.
struct KindStart {
  Scene scene;  ///< as it begins, at time 0, without defaults
  KindGiven given;
  Box3 seen;  ///< the bounds of what a person looks at, until its end
};

/// Completes the scene. `place` is where the file says its kind; the choices of options carry it. `start` is
/// null for a scene that does not change.
void addKindDefaults(Scene& scene, const KindGiven& given, const SourcePlace& place,
                     const KindStart* start = nullptr);

/// Do the defaults depend on where objects, lights or the camera are?
bool kindDefaultsFollow(const Scene& scene, const KindGiven& given);

/// The value of the option in such a file, of which the quality gives a part; "" if that is the option's
/// default.
std::string_view kindDefaultOf(std::string_view option);

/// Completes the scene of a file of meshes that is rendered by itself: its meshes look smooth where they have
/// no normals, and a better camera and light take the place of those of sceneOf() (formats/model.h). Any
/// other scene stays as it is. Not for conversions, which keep what the file has.
void completeBareMesh(Scene& scene);

/// Is an object or a medium in it emissive?
bool shines(const Scene& scene);

/// The bounds of what a person looks at: of all objects that end somewhere, except for a floor that is much
/// larger than all that stands on it.
Box3 boundsOfInterest(const Scene& scene);

}  // namespace trace
