// The lines of a material file of an OBJ that its reader, tinyobj, passes over in silence.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "formats/textures.h"
#include "formats/warnings.h"

namespace trace {

/// Notes the textures that are not rendered, where each picture is named first, and warns of lines that are
/// not known, of what should be a number and is none, and of numbers out of their range. Returns the text as
/// tinyobj can read it: continued lines are one, a colour of one number has three, options of a texture have
/// all their numbers, and what a texture multiplies is white where the material does not say it. Linear in
/// the text.
std::string checkedMtl(const std::string& file, std::string_view text, UnusedTextures& textures,
                       std::map<std::string, Place, std::less<>>& pictures, WarningsByKind& warnings);

}  // namespace trace
