// The lines of an OBJ file, before tinyobjloader takes them apart: it reads what is no number as 0, and
// passes over what it does not know.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/warnings.h"
#include "math/vec.h"

namespace trace {

/// What the lines name, and where: the offset in the text. And the colours of points, which tinyobj does not
/// hand on: one for each point, white for those without, or none at all.
struct ObjNames {
  std::map<std::string, std::size_t, std::less<>> materials;       ///< of the first use
  std::vector<std::pair<std::string, std::size_t>> materialFiles;  ///< all of a line as one
  std::vector<Vec3f> colors;
};

/// Checks the numbers of the points, normals, uv and faces. Warns of what is left out and of lines that are
/// not known. Throws Error(Fault::scene) with line and column. Linear in the text. `lines` are the bytes with
/// continued lines made one.
ObjNames checkObjLines(const std::string& file, std::string_view bytes, std::string_view lines,
                       WarningsByKind& warnings);

}  // namespace trace
