// The words of a line of an OBJ or MTL file.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/text.h"

namespace trace {

/// One word after the other; refers to the line.
class LineWords {
 public:
  explicit LineWords(std::string_view line) : rest_(line) {}

  /// Empty at the end.
  std::string_view next() {
    skip();
    std::size_t length = 0;
    while (length < rest_.size() && !isBlank(rest_[length])) ++length;
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }
  std::string_view peek() const { return LineWords(*this).next(); }
  bool atEnd() { return skip(), rest_.empty(); }
  /// The number of the next word; none, and the word stays, if it is no number or more than one.
  std::optional<double> nextNumber() {
    skip();
    const auto number = parseNumber(rest_);
    if (!number || (number->length < rest_.size() && !isBlank(rest_[number->length]))) return {};
    rest_.remove_prefix(number->length);
    return number->value;
  }
  /// All that is left.
  std::string_view left() const { return rest_; }
  /// The same, without the blanks around it.
  std::string_view rest() {
    skip();
    std::size_t length = rest_.size();
    while (length > 0 && isBlank(rest_[length - 1])) --length;
    return rest_.substr(0, length);
  }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip() {
    std::size_t blanks = 0;
    while (blanks < rest_.size() && isBlank(rest_[blanks])) ++blanks;
    rest_.remove_prefix(blanks);
  }

  std::string_view rest_;
};

inline bool listed(std::span<const std::string_view> list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Is the whole word a number that a float can hold?
inline bool isFloat(std::string_view word) {
  const auto number = parseNumber(word);
  return number && number->length == word.size() &&
         std::abs(number->value) <= std::numeric_limits<float>::max();
}

/// The text with continued lines made one: a \ at the end of a line, and that end, become blanks, so that
/// every byte stays where it was. A comment is not continued, for it may end in a path. `room` holds what is
/// new.
inline std::string_view joinedLines(std::string_view text, std::string& room) {
  if (text.find('\\') == text.npos) return text;
  room = text;
  bool inComment = false;
  for (std::size_t i = 0; i < room.size(); ++i) {
    inComment = room[i] == '#' || (inComment && room[i] != '\n');
    if (room[i] != '\\' || inComment) continue;
    std::size_t end = i + 1;
    if (end < room.size() && room[end] == '\r') ++end;
    if (end < room.size() && room[end] != '\n') continue;
    room.replace(i, std::min(end + 1, room.size()) - i, std::min(end + 1, room.size()) - i, ' ');
  }
  return room;
}

/// Why the word is not one: `expected a number, found "red"`.
inline std::string notAFloat(std::string_view word) {
  const auto number = parseNumber(word);
  const bool tooLarge = number && number->length == word.size();
  return std::string(tooLarge ? "expected a finite number of at most 3.4e38" : "expected a number") +
         ", found \"" + std::string(word.substr(0, 40)) + "\"";
}

/// Calls visit(line) for each line of the text.
template <class Visit>
void forEachLine(std::string_view text, Visit&& visit) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    visit(text.substr(start, end - start));
    start = end + 1;
  }
}

}  // namespace trace
