// Wavefront OBJ meshes with their MTL materials (Wavefront, Advanced Visualizer manual, appendix B).
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/model.h"

namespace trace {

/// Is the first line that is no comment one of an OBJ file, and is there a vertex?
bool recognisesObj(std::string_view bytes);
/// Is any line a point?
bool mayBeObj(std::string_view bytes);

/// One object for each group or object and material. Material files are looked for beside the file; without
/// them there is a warning. Throws Error(Fault::scene).
Model readObj(const std::string& file, std::string_view bytes, Messages& messages);

}  // namespace trace
