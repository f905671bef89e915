// Words and numbers in text, for readers and messages.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.h"

namespace trace {

/// The number at the start of `text` (what strtod takes, plus a leading '+'; no locale; correctly
/// rounded) and how many characters it took; nothing if there is none. Overflow gives an infinity.
struct ParsedNumber {
  double value;
  size_t length;
};
std::optional<ParsedNumber> parseNumber(std::string_view text);

/// The shortest decimal that reads back as the same number.
std::string toText(double number);

/// "1 error", "3 errors".
std::string counted(std::size_t n, std::string_view noun);

/// Appends the number as a decimal: the shortest that reads back as the same number, or with `digits` digits
/// that count. That of a float also reads back through a double. For bulk data: faster than toText().
void appendNumber(std::string& text, double number, int digits = 0);
void appendNumber(std::string& text, float number, int digits = 0);

/// The candidate nearest to a misspelt `word`, or "" when none is near.
std::string nearest(std::string_view word, std::span<const std::string_view> candidates);
/// `did you mean "..."?`, or "" when nothing is near.
std::string didYouMean(std::string_view word, std::span<const std::string_view> candidates);

/// Line, column and text of a byte offset in `source`. Linear in the offset; for messages only.
SourcePlace placeAt(std::string_view file, std::string_view source, size_t offset);

}  // namespace trace
