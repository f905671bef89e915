// Text scenes of Open Inventor 2.x, VRML 1.0 and VRML97: files *.iv and *.wrl.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/scene.h"

namespace trace {

bool recognisesInventor(std::string_view bytes);

/// Nodes that are not known are skipped with a warning. Throws Error(Fault::scene).
Scene readInventor(const std::string& file, std::string_view bytes, Messages& messages);

}  // namespace trace
