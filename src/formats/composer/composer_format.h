// Scenes of the composer, which the course of 1998 rendered: `Composer format 2.1`, text or binary, files
// *.out, *.scene and *.ascii.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/format.h"

namespace trace {

bool recognisesComposer(std::string_view bytes);

/// Throws Error(Fault::scene).
Scene readComposer(const std::string& file, std::string_view bytes, Messages& messages);

/// The scene as composer text. What the format does not have is left out, each with a warning once; shapes
/// other than spheres become triangles.
std::vector<NamedBytes> writeComposer(const Scene& scene, const std::string& file,
                                      const WriteOptions& options, Messages& messages);

}  // namespace trace
