// Parts of a page: colours, text, pictures.
#pragma once

#include <string>
#include <string_view>

#include "base/base64.h"

namespace trace {

/// The colours of a page, for light and dark screens.
inline constexpr std::string_view kPageColors = R"css(
:root { color-scheme: light dark; --ground: #fbfbfa; --ink: #1c1c1a; --faint: #6b6b66; --line: #d9d9d4;
  --card: #fff; --bad: #b3261e; --good: #1b6e3a; --accent: #0b57b7; }
@media (prefers-color-scheme: dark) { :root { --ground: #161615; --ink: #ececea; --faint: #a0a09a; --line: #3a3a37;
  --card: #1f1f1d; --bad: #ff8a80; --good: #7ddb9b; --accent: #8ab8ff; } }
)css";

/// The text with &, <, > and quotation marks as HTML has them.
inline std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// The bytes of a picture file as an address; `type` as in "png".
inline std::string dataAddress(std::string_view type, std::string_view bytes) {
  return "data:image/" + std::string(type) + ";base64," + toBase64(bytes);
}

}  // namespace trace
