// Flaws of a texture that can be used all the same.
#pragma once

#include <string>
#include <vector>

#include "shading/texture.h"

namespace trace {

/// Each as a sentence for a person; none for a texture as it should be. Of the textures in it they say
/// nothing.
std::vector<std::string> flawsOf(const TextureNode& node);

}  // namespace trace
