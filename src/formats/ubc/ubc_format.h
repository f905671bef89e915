// Scenes of the University of British Columbia, CPSC 314, and of its relatives in Montreal: files *.ray that
// begin with commands such as `Dimensions 640 480`. docs/formats.md has the grammar.
#pragma once

#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/scene.h"

namespace trace {

/// Does the file begin with one of the commands, or have it several at the beginning of lines?
bool recognisesUbc(std::string_view bytes);

/// Either grammar, of 2010 to 2013 (`Resolution`, `Camera`) or later. Throws Error(Fault::scene).
Scene readUbc(const std::string& file, std::string_view bytes, Messages& messages);

namespace ubc {
/// The grammar of 2010 to 2013 (ubc_old_format.cpp).
Scene readOld(const std::string& file, std::string_view bytes, Messages& messages);
}  // namespace ubc

}  // namespace trace
