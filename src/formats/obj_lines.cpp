#include "formats/obj_lines.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/budget.h"
#include "base/error.h"
#include "formats/obj_words.h"

namespace trace {
namespace {

constexpr std::array<std::string_view, 5> kDrawn{"g", "o", "s", "mtllib", "usemtl"};
constexpr std::array<std::string_view, 2> kThin{"l", "p"};
constexpr std::array<std::string_view, 4> kCurved{"curv", "curv2", "surf", "fo"};
/// What belongs to curves and surfaces, which are told of by themselves, or says nothing that a picture
/// shows.
constexpr std::array<std::string_view, 25> kSilent{
    "vp",        "cstype", "deg",   "bmat",   "step",   "parm",     "trim",     "hole", "scrv",
    "sp",        "end",    "con",   "mg",     "bevel",  "c_interp", "d_interp", "lod",  "shadow_obj",
    "trace_obj", "ctech",  "stech", "maplib", "usemap", "csh",      "call"};

template <std::size_t N>
bool has(const std::array<std::string_view, N>& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
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
  Checker(const std::string& file, std::string_view bytes, WarningsByKind& warnings)
      : file_(file), bytes_(bytes), warnings_(warnings) {}

  MaterialUses check() {
    forEachLine(bytes_, [&](std::string_view text) {
      checkBudget();
      line(text);
    });
    return std::move(materials_);
  }

 private:
  void line(std::string_view text) {
    if (const std::size_t comment = text.find('#'); comment != text.npos) text = text.substr(0, comment);
    LineWords words(text);
    const std::string_view key = words.next();
    if (key == "v")
      point(text, words);
    else if (key == "vn")
      numbers(text, words, key, 3, 3);
    else if (key == "vt")
      numbers(text, words, key, 1, 3);
    else if (key == "f")
      face(key, words);
    else
      other(key, words);
  }

  void other(std::string_view key, LineWords words) {
    if (key == "usemtl") {
      const std::string_view name = words.rest();
      if (name.empty()) return warn(key, "usemtl: expected the name of a material");
      materials_.try_emplace(std::string(name), static_cast<std::size_t>(name.data() - bytes_.data()));
    }
    if (key.empty() || has(kDrawn, key) || has(kSilent, key)) return;
    if (has(kThin, key)) return warn(key, "points and lines are left out");
    if (has(kCurved, key)) return warn(key, "curves and surfaces are left out");
    warn(key, "\"" + std::string(key.substr(0, 40)) + "\" is not known and is skipped");
  }

  /// Three numbers, perhaps with a weight or a colour.
  void point(std::string_view text, LineWords words) {
    const int count = numbers(text, words, "v", 3, 7);
    if (count == 5) warn(text, "v: expected 3 numbers, found 5; the last two are ignored");
  }

  int numbers(std::string_view text, LineWords words, std::string_view key, int least, int most) {
    int count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count)
      if (!isFloat(word)) fail(word, "expected a number, found \"" + std::string(word.substr(0, 40)) + "\"");
    if (count < least)
      fail(text, "expected " + std::to_string(least) + " numbers after \"" + std::string(key) + "\", found " +
                     std::to_string(count));
    if (count > most)
      warn(text, std::string(key) + ": expected at most " + std::to_string(most) +
                     " numbers, found more; they are ignored");
    return count;
  }

  void face(std::string_view key, LineWords words) {
    int count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count)
      if (!isCorner(word))
        fail(word, "expected a corner such as 7, 7/8, 7//9 or 7/8/9, found \"" +
                       std::string(word.substr(0, 40)) + "\"");
    if (count < 3) warn(key, "a face of fewer than 3 points is left out");
  }

  void warn(std::string_view at, std::string what) {
    if (!warnings_.again(what)) warnings_.warn(place(at), std::move(what));
  }
  [[noreturn]] void fail(std::string_view at, std::string what) const {
    throw Error(Fault::scene, place(at), std::move(what));
  }
  Place place(std::string_view at) const {
    return placeAt(file_, bytes_, static_cast<std::size_t>(at.data() - bytes_.data()));
  }

  const std::string& file_;
  std::string_view bytes_;
  WarningsByKind& warnings_;
  MaterialUses materials_;
};

}  // namespace

MaterialUses checkObjLines(const std::string& file, std::string_view bytes, WarningsByKind& warnings) {
  return Checker(file, bytes, warnings).check();
}

}  // namespace trace
