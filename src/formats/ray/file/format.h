// Scenes of the courses of Washington, Austin and Hong Kong: `SBT-raytracer 1.0` (files *.ray).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/scene_time.h"
#include "scene/scene.h"

namespace trace {

/// Does the content begin, after white space and comments, with the word SBT-raytracer?
bool recognisesRay(std::string_view bytes);

/// The scene at `time`, in seconds: that of its `key(...)` (ray_keys.h) and of its particles. Throws
/// Error(Fault::scene) with up to twenty errors; one, if the syntax is wrong.
Scene readRay(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time);
Scene readRay(const std::string& file, std::string_view bytes, Messages& messages, Real time = 0);

/// The textures of the file that have names, used or not, with their pictures loaded. Throws as readRay().
std::vector<Texture> readNamedTextures(const std::string& file, std::string_view bytes, Messages& messages,
                                       Real time = 0);

}  // namespace trace
