// Textures in the text of a .ray file, changed where they are said: the lines of what stays stay.
#pragma once

#include <string>

#include "formats/ray/write/edits.h"
#include "shading/texture.h"

namespace trace::rayfile {

/// Makes of the texture `was`, which stands in `value` and scales the constant `from`, the texture `is` with
/// the constant `to`. False, with nothing changed, if only another text says that.
bool changeTexture(TextEdits& edits, const Item& value, const Texture& was, const std::string& from,
                   const Texture& is, const std::string& to);

}  // namespace trace::rayfile
