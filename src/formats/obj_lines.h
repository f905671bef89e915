// The lines of an OBJ file, before tinyobjloader takes them apart: it reads what is no number as 0, and
// passes over what it does not know.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "formats/warnings.h"

namespace trace {

/// Where each material is used first: the offset of its name.
using MaterialUses = std::map<std::string, std::size_t, std::less<>>;

/// Checks the numbers of the points, normals, uv and faces. Warns of what is left out and of lines that are
/// not known. Throws Error(Fault::scene) with line and column. Linear in the text.
MaterialUses checkObjLines(const std::string& file, std::string_view bytes, WarningsByKind& warnings);

}  // namespace trace
