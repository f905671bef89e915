// Binary files of Open Inventor 2.0 and 2.1 as the text that they stand for.
#pragma once

#include <string>
#include <string_view>

namespace trace::inventor {

/// Does the file begin with the header of a binary one?
bool isBinary(std::string_view bytes);

/// The file as `ivcat` writes it, on one line for each node. Names of nodes get other characters where a text
/// cannot have them. Throws Error(Fault::scene) for bytes that are damaged, of version 1.0, or have a field
/// of a type that is not known.
std::string textOfBinary(const std::string& file, std::string_view bytes);

}  // namespace trace::inventor
