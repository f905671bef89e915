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
  int layer = -1;         ///< of the Film; -1 is the picture
  std::string_view pass;  ///< its name; "" is the picture
};

/// The picture at `path` first, then "NAME.PASS.exr" and the like beside it, in the order of the film's
/// layers.
std::vector<Output> outputs(const std::string& path, const Settings& settings);

/// Sixteen digits for what a scene's file says and the meshes it names: equal for equal scenes, and
/// different, as far as 64 bits can tell, for different ones.
std::string fingerprint(std::string_view bytes, const Scene& scene);

/// Is the file there, rendered to its end, and were its words those of `metadata`? Options that do not change
/// pixels, such as --threads, do not count. Never of a format that keeps no words.
bool isRendered(const Output& output, const Metadata& metadata);

/// Writes what is done of the film so far, and `metadata`, to which the words Pass, of a pass, and
/// Incomplete, of a film with tiles to come, are added. A picture gets the tone of the settings unless its
/// format keeps values above 1; passes are raw in OpenEXR only. Throws Error(Fault::io), Error(Fault::usage).
void write(const Output& output, const Film& film, const Settings& settings, Metadata metadata);

/// Program version, settings that differ from the defaults and the scene's name, as the picture keeps them.
Metadata describe(const Scene& scene, const Settings& settings);

}  // namespace trace
