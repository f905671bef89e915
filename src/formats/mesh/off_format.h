// Polygon meshes as OFF files, text: points and faces, with normals, colours and texture coordinates of
// points if the first word says so, as in COFF or STNOFF (Geomview manual, section "OFF Files").
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "formats/model.h"

namespace trace {

bool recognisesOff(std::string_view bytes);
/// Does it begin with three counts, as a file without the word OFF does?
bool mayBeOff(std::string_view bytes);

/// One object. Colours of faces are left out. Throws Error(Fault::scene).
Model readOff(const std::string& file, std::string_view bytes, Messages& messages);

}  // namespace trace
