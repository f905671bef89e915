// The meshes of a scene as PLY and OBJ files, in world space, and pictures on them.
#pragma once

#include <string>
#include <vector>

#include "formats/format.h"

namespace trace {

/// One mesh of all triangles, binary unless `options.ascii`. Where the points have several materials, their
/// diffuse colours are written.
std::vector<NamedBytes> writePly(const Scene& scene, const std::string& file, const WriteOptions& options,
                                 Messages& messages);

/// An object for each, and their materials in a file beside it: NAME.mtl, or another name if that file is
/// there and is not the one that the OBJ file in this place names.
std::vector<NamedBytes> writeObj(const Scene& scene, const std::string& file, const WriteOptions& options,
                                 Messages& messages);

}  // namespace trace
