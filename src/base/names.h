// Names from files, as text that a line of any file can hold.
//
// glTF, VRML and file names may hold line breaks, quotes and bytes that are no letters. Every writer asks one
// of these, so that a name stays a name wherever it is written.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace trace {

/// How many bytes the letter at the start of `text` has in UTF-8, and which it is; 0 bytes if it is none.
struct Utf8Letter {
  std::size_t bytes;
  std::uint32_t code;
};
inline Utf8Letter utf8Letter(std::string_view text) {
  if (text.empty()) return {0, 0};
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return {1, lead};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {0, 0};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xC0) != 0x80) return {0, 0};
    code = code << 6 | (next & 0x3Fu);
  }
  const std::uint32_t least = bytes == 2 ? 0x80 : bytes == 3 ? 0x800 : 0x10000;
  const bool sound = code >= least && code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF);
  return sound ? Utf8Letter{bytes, code} : Utf8Letter{0, 0};
}

/// The text on one line: what is no letter of UTF-8, control characters and line breaks become "_".
inline std::string onOneLine(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const auto [bytes, code] = utf8Letter(text);
    const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
    if (bytes == 0 || control)
      line += '_';
    else
      line += text.substr(0, bytes);
    text.remove_prefix(bytes > 0 ? bytes : 1);
  }
  return line;
}

/// onOneLine(), and each of the characters `without` becomes `instead`.
inline std::string onOneLine(std::string_view text, std::string_view without, char instead = '_') {
  std::string line = onOneLine(text);
  for (char& c : line)
    if (without.find(c) != std::string_view::npos) c = instead;
  return line;
}

}  // namespace trace
