// Statements that a program adds to a scene, in the place of a file (library/scene_state.h).
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/kind_defaults.h"
#include "scene/scene.h"

namespace trace::rayfile {

/// The settings that the statements give, so that kind defaults leave them.
struct PartGiven {
  KindGiven kind;
  bool camera = false, background = false;
};

/// Reads statements of the kind `Trace 1`, without its first line, behind what the scene has; a camera or
/// background takes the place of the one that is there. Kind defaults are not added, and pictures of textures
/// not loaded. Places have the name `file`, which also has the folder of files that are named, and lines
/// count from 2. Throws as readRay(); the scene may then have a part of them.
PartGiven readPart(const std::string& file, std::string_view statements, Scene& scene, Messages& messages);

}  // namespace trace::rayfile
