// THE table of what other renderers do differently with a scene: other conventions, terms of the equation
// that are missing, signs that are wrong, cameras that are read otherwise. `ray diff --scene` renders each
// (app/compare/scene_cause.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace trace {

/// A change of a scene and its settings that a program may have made.
struct SceneVariant {
  std::string text;  ///< follows on "what scene.ray gives": "without shadows", "with --highlight phong"
  std::function<void(Scene&, Settings&)> apply;
  bool isOption = false;  ///< it gives an option another value
};

/// The variants that change the scene or the settings, the simplest first: one thing that is missing, then
/// options, then other changes. Where two give the same picture, the first counts.
std::vector<SceneVariant> variantsOf(const Scene& scene, const Settings& settings);

}  // namespace trace
