// `ray expand`: a scene as plain text, in which loops, functions, names and included files are computed
// (docs/language.md). It renders the same, bit for bit.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "math/vec.h"
#include "scene/input_files.h"

namespace trace {

struct Expansion {
  std::string text;
  bool changesWithTime = false;  ///< it holds for one moment only
  InputFiles inputs{};           ///< files that were included
};

/// The text of a .ray file at a moment in seconds. A comment before each object of the top level says which
/// line made it, and which calls and rounds of loops. Throws as readRay() (ray_format.h) does for the
/// language.
Expansion expansionOf(const std::string& file, std::string_view text, Real time);

}  // namespace trace
