// The words, numbers, strings and marks of a text file, one after the other: the first layer of the readers
// of formats without a deeper grammar of their own.
//
// A word ends at white space, a mark, a quote or a comment. What begins like a number and is one up to its
// end is a number. Time is linear in the text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace trace {

struct Token {
  enum class Kind { end, number, word, string, mark };

  Kind kind = Kind::end;
  std::string_view text;  ///< as in the file; of a string without its quotes
  double number = 0;
  std::size_t offset = 0;

  bool is(Kind k) const { return kind == k; }
  bool isWord(std::string_view word) const { return kind == Kind::word && text == word; }
  bool isMark(char mark) const { return kind == Kind::mark && text[0] == mark; }
};

/// The differences between the formats.
struct TokenRules {
  std::string_view marks;  ///< characters that are tokens by themselves
  char comment = 0;        ///< begins a comment that ends with the line; 0: there are none
  bool commasAreBlank = false;
  bool stringEscapes = false;  ///< \" in a string does not end it
  bool hasPlaces = true;       ///< false for a text that is not in the file: places are the file as a whole
};

class Tokens {
 public:
  /// Refers to the source. `start` is the offset of the first token.
  Tokens(std::string file, std::string_view source, const TokenRules& rules, std::size_t start = 0);

  /// The next token, again and again until next().
  const Token& peek() const { return next_; }
  /// Throws Error(Fault::scene) for a string that never ends, or a number that is not finite.
  Token next();
  bool atEnd() const { return next_.is(Token::Kind::end); }
  /// Moves on if the next token is that mark or word.
  bool skipMark(char mark);
  bool skipWord(std::string_view word);
  /// The token after the next one is that mark.
  bool markFollows(char mark) const;

  // Each throws Error(Fault::scene), "WHAT: expected a number, found ...", if the next token is another.
  double number(std::string_view what);
  Token word(std::string_view what);
  Token string(std::string_view what);
  void mark(char mark, std::string_view what);

  [[noreturn]] void fail(const Token& at, std::string what, std::string hint = {}) const;
  /// Fails at the next token with "WHAT: expected EXPECTED, found ...".
  [[noreturn]] void expected(std::string_view what, std::string_view expected, std::string hint = {}) const;

  /// With the line of text if it is not very long.
  SourcePlace place(const Token& token) const;
  const std::string& file() const { return file_; }
  /// Is it a token of this text?
  bool holds(const Token& token) const {
    return token.text.data() >= source_.data() && token.text.data() <= source_.data() + source_.size();
  }

 private:
  void advance();
  std::size_t skipBlanks(std::size_t at) const;
  std::size_t wordEnd(std::size_t at) const;

  std::string file_;
  std::string_view source_;
  TokenRules rules_;
  std::vector<std::uint32_t> lineStarts_;
  std::size_t at_;
  Token next_;
};

/// For messages: `"word"`, `12`, `the end of the file`.
std::string describe(const Token& token);

}  // namespace trace
