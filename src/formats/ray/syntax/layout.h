// The layout of a .ray file, tidied: `ray format`. Only blanks and line breaks change, and numbers, words,
// comments and the order of everything stay, so that the file means what it meant.
#pragma once

#include <string>
#include <string_view>

namespace trace {

/// The text with two blanks for each level of brackets, one statement's marks spaced in one way, comments at
/// the ends of lines in one column, and no more than one empty line in a row. Tidying the result changes
/// nothing. Throws Error(Fault::scene) where the text is not of the grammar of .ray files.
std::string tidied(const std::string& file, std::string_view text);

}  // namespace trace
