// The words, numbers, strings and marks of a POV-Ray file, split once: loops and macros read the same tokens
// again and again. Source: the POV-Ray 3.7 reference, section 2.2.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace trace::pov {

struct Source;

struct Token {
  enum class Kind : std::uint8_t {
    end,
    number,
    name,
    string,     ///< text is what stands between the quotation marks, with its escapes
    mark,       ///< one character, or <= >= !=
    directive,  ///< text is the word after #
  };

  Kind kind = Kind::end;
  std::string_view text;
  double number = 0;
  std::uint32_t offset = 0;
  const Source* source = nullptr;

  bool is(Kind k) const { return kind == k; }
  bool isMark(std::string_view mark) const { return kind == Kind::mark && text == mark; }
  bool isName(std::string_view name) const { return kind == Kind::name && text == name; }
};

/// A file as tokens, which refer to its text.
struct Source {
  std::string file, text;
  std::vector<Token> tokens{};

  /// Throws Error(Fault::scene) for a comment or string without an end.
  Source(std::string name, std::string bytes);
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  SourcePlace place(std::size_t offset) const;

 private:
  void split();
  std::vector<std::uint32_t> lineStarts_;
};

/// For messages: `"word"`, `12`, `the end of the file`.
std::string describe(const Token& token);

/// The text of a string: its escapes are replaced.
std::string unescaped(std::string_view text);

}  // namespace trace::pov
