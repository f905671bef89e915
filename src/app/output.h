// The files that a render writes: the picture, and one more for each pass.
#pragma once

#include <string>
#include <vector>

#include "image/film.h"
#include "image/metadata.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

struct Output {
  std::string path;
  int layer = -1;  ///< of the Film; -1 is the picture
};

/// The picture at `path` first, then "NAME.PASS.exr" and the like beside it, in the order of the film's
/// layers.
std::vector<Output> outputs(const std::string& path, const Settings& settings);

/// Writes what is done of the film so far, with the settings as metadata. A picture gets the tone of the
/// settings unless its format keeps values above 1; passes are raw in OpenEXR only.
/// Throws Error(Fault::io), Error(Fault::usage).
void write(const Output& output, const Film& film, const Scene& scene, const Settings& settings);

/// Program version, settings that differ from the defaults and the scene's name, as the picture keeps them.
Metadata describe(const Scene& scene, const Settings& settings);

}  // namespace trace
