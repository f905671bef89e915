// Text scenes of Open Inventor 2.x, VRML 1.0 and VRML97: files *.iv and *.wrl.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/format.h"
#include "scene/scene.h"

namespace trace {

bool recognisesInventor(std::string_view bytes);

/// Nodes that are not known are skipped with a warning. Throws Error(Fault::scene).
Scene readInventor(const std::string& file, std::string_view bytes, Messages& messages);

/// VRML 1.0 if the file is named so, else Open Inventor 2.1. Warns of what they cannot hold. Throws
/// Error(Fault::scene) if nothing is left.
std::vector<NamedBytes> writeInventor(const Scene& scene, const std::string& file,
                                      const WriteOptions& options, Messages& messages);

}  // namespace trace
