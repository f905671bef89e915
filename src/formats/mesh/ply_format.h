// Polygon meshes as PLY files, text and binary.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/model.h"

namespace trace {

/// Does the file begin with a line "ply"?
bool recognisesPly(std::string_view bytes);

/// One object. Throws Error(Fault::scene).
Model readPly(const std::string& file, std::string_view bytes, Messages& messages);

}  // namespace trace
