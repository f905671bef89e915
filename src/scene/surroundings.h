// The pictures that a scene's settings name: backdrop and environment around it, and the opening of the lens.
#pragma once

#include <memory>
#include <string>

#include "base/error.h"
#include "image/codecs/codec.h"
#include "scene/input_files.h"
#include "scene/settings.h"
#include "shading/cameras/aperture.h"
#include "shading/environment_map.h"

namespace trace {

struct Scene;

/// Constant data that copies of a scene share; null where the settings name none.
struct Surroundings {
  std::shared_ptr<const Picture> backdrop;
  std::shared_ptr<const EnvironmentMap> environment;         ///< blurred
  std::shared_ptr<const EnvironmentMap> sharpEnvironment{};  ///< as it was read

  std::shared_ptr<const Aperture> aperture{};

  // The files and settings that they were made from.
  FilePath backdropFile{}, environmentFile{}, apertureFile{};
  EnvironmentKind kind = EnvironmentKind::automatic;
  Real blur = 0;
  InputFiles files{};

  /// Always equal: they follow from the settings.
  bool operator==(const Surroundings&) const { return true; }
};

/// Reads into Scene::surroundings what the settings name, unless they, or `before`, have it already. Notes
/// the files in Scene::inputs. A picture that cannot be read throws Error(Fault::io), or, where the scene
/// itself names it, is a warning, and a checker in its place. Throws Error(Fault::limit) where memory lacks.
void readSurroundings(Scene& scene, const Settings& settings, const PictureLimits& limits, Messages& messages,
                      const Surroundings* before = nullptr);

}  // namespace trace
