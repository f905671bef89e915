// Scenes of POV-Ray 3.7: files *.pov (docs/how-to/from-pov-ray.md).
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/scene_time.h"
#include "scene/scene.h"

namespace trace {

/// Does the text begin as such scenes do: with a directive, or the block of a statement?
bool recognisesPov(std::string_view bytes);
/// A text of which nothing else is known but its name.
bool mayBePov(std::string_view bytes);

/// Runs the scene's directives. What Trace does not have is left out with a warning for each kind. Throws
/// Error(Fault::scene), and Error(Fault::limit) for loops and recursion without an end.
Scene readPov(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time);

}  // namespace trace
