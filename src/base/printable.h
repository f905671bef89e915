// Text that others wrote, such as the name of a file, made safe for a terminal: nothing in it moves the
// cursor, changes colours, rings, begins a line or turns the direction of writing.
#pragma once

#include <string>
#include <string_view>

namespace trace {

enum class LineEnds { escaped, kept };

/// The text as UTF-8 with every control character as `\u001b` and every byte that is no UTF-8 as `\x9b`. Kept
/// line ends come with tabs. Text that JSON allows stays JSON.
std::string printable(std::string_view text, LineEnds lineEnds = LineEnds::escaped);

/// As many bytes as before: `?` for each that printable() would escape.
std::string printableInPlace(std::string_view text);

}  // namespace trace
