// Names that a .ray file cannot hold: its words end at a quotation mark and at the end of a line, and nothing
// escapes these, since the files of the courses have backslashes that mean nothing.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"

namespace trace {

struct Scene;

/// Does a word hold the letter? Of control characters, which command terminals, only the tab.
inline bool isHeld(char c) { return c == '\t' || (c != '"' && static_cast<unsigned char>(c) >= ' '); }

/// Can a .ray file hold the text between quotation marks as it is?
bool isSayable(std::string_view text);

/// Characters that a .ray file cannot hold.
struct Unsayable {
  std::string text;
  bool isFile = false;
  std::string why() const;
  std::string hint() const;
};
/// The first file that the scene names so; if there is none, the first object, light or material.
std::optional<Unsayable> unsayableIn(const Scene& scene);

/// Warns if a name of the scene is written as another. Files are never: `written` throws for these.
void warnOfUnsayable(const Scene& scene, const std::string& file, Messages& messages);

}  // namespace trace
