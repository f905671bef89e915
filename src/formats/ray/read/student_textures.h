// Textures as students of the courses added them to .ray.
#pragma once

#include <string_view>

#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "shading/texture.h"

namespace trace::rayfile {

/// The keyword of the texture that others call `word`, or `word`.
std::string_view textureKeyword(std::string_view word);

/// Reads the marble of a project at Hong Kong:
///   marble { color = (r, g, b); lightness = l; contrast = c; frequency = f; scale = (x, y, z); depth = n; }
/// color times l + (1 - l) sin(f (x + c noise(scale p))), where noise has n octaves, each half as strong as
/// the one before. False, and nothing is read, if the block is not one.
bool readStudentMarble(Findings& findings, const Item& block, TextureNode& to);

}  // namespace trace::rayfile
