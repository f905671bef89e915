// The text of a .ray file read into the nodes of a Syntax: recursive descent, with one word of lookahead.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/ray/syntax/syntax.h"

namespace trace::rayfile {

/// The text in quotation marks, for messages.
std::string quoted(std::string_view text);

/// Features of the text that need another look.
struct Parsed {
  bool hasKeys = false, usesLanguage = false;
  /// Numbers with two points, as in "0.3.0": what stands before the second counts.
  struct Slip {
    std::uint32_t offset;
    std::string text, readAs;
  };
  std::vector<Slip> slips{};
};

/// Appends the items of the text as one block. `syntax` gives messages their places; the text's first byte
/// has the offset `base` there. Throws as Syntax::Syntax().
Parsed parseRay(const Syntax& syntax, std::string_view text, std::uint32_t base, std::vector<Node>& nodes);

}  // namespace trace::rayfile
