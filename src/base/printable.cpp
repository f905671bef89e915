#include "base/printable.h"

#include <cstdint>
#include <cstdio>

namespace trace {
namespace {

struct Letter {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: no UTF-8
};

/// The first letter of the text, which is not empty (RFC 3629, section 4).
Letter letterOf(std::string_view text) {
  const auto byte = [&](std::size_t i) -> std::uint32_t { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xC2 && lead < 0xE0   ? 2
                            : lead >= 0xE0 && lead < 0xF0 ? 3
                            : lead >= 0xF0 && lead < 0xF5 ? 4
                                                          : 0;
  if (bytes == 0 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0xFFu >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3F);
  }
  const std::uint32_t least = bytes == 2 ? 0x80 : bytes == 3 ? 0x800 : 0x10000;
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  if (code < least || code > 0x10FFFF || surrogate) return {};
  return {code, bytes};
}

/// Control characters, line and paragraph separators, and those that turn the direction of writing.
bool controls(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x200E || code == 0x200F ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

/// Calls keep(letter) for what may be shown, and escape(code, bytes) for the rest; the code of a byte that is
/// no UTF-8 is its value, and bytes is then 0.
template <class Keep, class Escape>
void forEachLetter(std::string_view text, Keep&& keep, Escape&& escape) {
  while (!text.empty()) {
    const Letter letter = letterOf(text);
    if (letter.bytes == 0)
      escape(static_cast<unsigned char>(text[0]), std::size_t{0});
    else if (controls(letter.code))
      escape(letter.code, letter.bytes);
    else
      keep(text.substr(0, letter.bytes));
    text.remove_prefix(letter.bytes == 0 ? 1 : letter.bytes);
  }
}

}  // namespace

std::string printable(std::string_view text, LineEnds lineEnds) {
  std::string result;
  result.reserve(text.size());
  forEachLetter(
      text, [&](std::string_view letter) { result += letter; },
      [&](std::uint32_t code, std::size_t bytes) {
        if (lineEnds == LineEnds::kept && bytes == 1 && (code == '\n' || code == '\t')) {
          result += static_cast<char>(code);
          return;
        }
        char escaped[12];
        std::snprintf(escaped, sizeof escaped, bytes == 0 ? "\\x%02x" : "\\u%04x", code);
        result += escaped;
      });
  return result;
}

std::string printableInPlace(std::string_view text) {
  std::string result;
  forEachLetter(
      text, [&](std::string_view letter) { result += letter; },
      [&](std::uint32_t, std::size_t bytes) { result.append(bytes == 0 ? 1 : bytes, '?'); });
  return result;
}

}  // namespace trace
