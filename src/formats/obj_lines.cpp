#include "formats/obj_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/budget.h"
#include "base/error.h"
#include "base/text.h"

namespace trace {
namespace {

constexpr std::string_view kBlank = " \t\r";

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view next() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlank));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

bool isNumber(std::string_view word) {
  const auto number = parseNumber(word);
  return number && number->length == word.size() &&
         std::abs(number->value) <= std::numeric_limits<float>::max();
}

/// 7, 7/8, 7//9 or 7/8/9, each perhaps negative.
bool isCorner(std::string_view word) {
  for (int part = 0; part < 3; ++part) {
    if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
    const std::size_t digits = std::min(word.find_first_not_of("0123456789"), word.size());
    if (digits > 9 || (digits == 0 && part != 1)) return false;  // only uv may be left out
    word.remove_prefix(digits);
    if (word.empty()) return digits > 0;
    if (word[0] != '/') return false;
    word.remove_prefix(1);
  }
  return false;
}

class Checker {
 public:
  Checker(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::size_t check() {
    for (std::size_t start = 0; start < bytes_.size();) {
      checkBudget();
      const std::size_t end = std::min(bytes_.find('\n', start), bytes_.size());
      line(bytes_.substr(start, end - start));
      start = end + 1;
    }
    return unusable_;
  }

 private:
  void line(std::string_view text) {
    if (const std::size_t comment = text.find('#'); comment != text.npos) text = text.substr(0, comment);
    Words words(text);
    const std::string_view key = words.next();
    if (key == "v" || key == "vn")
      numbers(text, words, key, 3);
    else if (key == "vt")
      numbers(text, words, key, 1);
    else if (key == "f")
      face(words);
  }

  void numbers(std::string_view text, Words words, std::string_view key, int least) {
    int count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count)
      if (!isNumber(word)) fail(word, "expected a number, found \"" + std::string(word.substr(0, 40)) + "\"");
    if (count < least)
      fail(text, "expected " + std::to_string(least) + " numbers after \"" + std::string(key) + "\", found " +
                     std::to_string(count));
  }

  void face(Words words) {
    int count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count)
      if (!isCorner(word))
        fail(word, "expected a corner such as 7, 7/8, 7//9 or 7/8/9, found \"" +
                       std::string(word.substr(0, 40)) + "\"");
    if (count < 3) ++unusable_;
  }

  [[noreturn]] void fail(std::string_view at, std::string what) const {
    throw Error(Fault::scene, placeAt(file_, bytes_, static_cast<std::size_t>(at.data() - bytes_.data())),
                std::move(what));
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t unusable_ = 0;
};

}  // namespace

std::size_t checkObjLines(const std::string& file, std::string_view bytes) {
  return Checker(file, bytes).check();
}

}  // namespace trace
