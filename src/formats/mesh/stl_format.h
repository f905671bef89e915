// Triangles as STL files, text and binary (3D Systems, StereoLithography Interface Specification, 1989).
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/model.h"

namespace trace {

/// A binary file has exactly the size that its count says; a text begins with "solid" and has facets.
bool recognisesStl(std::string_view bytes);
/// Can it be a binary file that is too long or too short?
bool mayBeStl(std::string_view bytes);

/// One object for each solid. Equal corners become one point; the normals of facets are not used, as they
/// only repeat the order of the corners. Throws Error(Fault::scene).
Model readStl(const std::string& file, std::string_view bytes, Messages& messages);

}  // namespace trace
