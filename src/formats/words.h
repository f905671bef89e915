// A text as words between white space, for mesh formats that need no more grammar than that.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace trace {

/// Are they the same, in letters of any case?
inline bool sameWord(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// Does the text have it somewhere, in letters of any case?
inline bool hasWord(std::string_view text, std::string_view word) {
  for (std::size_t i = 0; i + word.size() <= text.size(); ++i)
    if (sameWord(text.substr(i, word.size()), word)) return true;
  return false;
}

class Words {
 public:
  /// `comment` starts one that ends with the line; '\0' for none.
  Words(const std::string& file, std::string_view text, char comment)
      : file_(file), text_(text), comment_(comment) {}

  /// The next word; empty at the end.
  std::string_view next() {
    skip();
    start_ = at_;
    while (at_ < text_.size() && !isBlank(text_[at_])) ++at_;
    return text_.substr(start_, at_ - start_);
  }

  bool atEnd() {
    skip();
    return at_ == text_.size();
  }

  /// That of the last next() or number().
  std::string_view last() const { return text_.substr(start_, at_ - start_); }

  /// Throws Error(Fault::scene) where there is no number.
  double number(std::string_view what) {
    const std::string_view word = next();
    const auto parsed = parseNumber(word);
    if (!parsed || parsed->length != word.size()) fail("expected " + std::string(what), word);
    return parsed->value;
  }

  /// The rest of the line, without the blanks around it.
  std::string_view line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && isBlank(rest.back())) rest.remove_suffix(1);
    return rest;
  }

  /// Continues at that byte.
  void skipTo(std::size_t at) { at_ = at; }

  /// Where the last word begins.
  SourcePlace place() const { return placeAt(start_); }
  std::size_t start() const { return start_; }
  /// Where that byte is.
  SourcePlace placeAt(std::size_t at) const { return trace::placeAt(file_, text_, at); }

  /// Bytes not read yet: no count in a file can be larger.
  std::size_t left() const { return text_.size() - at_; }

  [[noreturn]] void fail(std::string what, std::string_view found) const {
    what += found.empty() ? ", found the end of the file"
                          : ", found \"" + std::string(found.substr(0, 40)) + "\"";
    throw Error(Fault::scene, place(), std::move(what));
  }
  [[noreturn]] void fail(std::string what) const { throw Error(Fault::scene, place(), std::move(what)); }

 private:
  static bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip() {
    while (at_ < text_.size()) {
      if (comment_ && text_[at_] == comment_)
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (isBlank(text_[at_]))
        ++at_;
      else
        return;
    }
  }

  const std::string& file_;
  std::string_view text_;
  char comment_;
  std::size_t at_ = 0, start_ = 0;
};

}  // namespace trace
