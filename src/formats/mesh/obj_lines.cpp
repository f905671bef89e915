#include "formats/mesh/obj_lines.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/error.h"
#include "base/text.h"
#include "formats/mesh/obj_words.h"

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

/// What a corner says of a face: numbers of a point, a uv and a normal; 0 for none.
struct CornerNumbers {
  std::int64_t point = 0, uv = 0, normal = 0;
};

/// 7, 7/8, 7//9 or 7/8/9, each perhaps negative; nothing of another form. A point's number may be too large
/// for any file, and is then as large as can be.
std::optional<CornerNumbers> cornerOf(std::string_view word) {
  CornerNumbers corner;
  for (std::int64_t* number : {&corner.point, &corner.uv, &corner.normal}) {
    const bool negative = word.starts_with('-');
    if (negative || word.starts_with('+')) word.remove_prefix(1);
    const std::size_t digits = std::min(word.find_first_not_of("0123456789"), word.size());
    const bool isPoint = number == &corner.point;
    if ((digits > 9 && !isPoint) || (digits == 0 && number != &corner.uv)) return {};  // uv may be left out
    for (std::size_t i = 0; i < digits; ++i)
      *number = std::min<std::int64_t>(*number * 10 + (word[i] - '0'), std::int64_t{1} << 40);
    if (negative) *number = -*number;
    word.remove_prefix(digits);
    if (word.empty()) return digits > 0 ? std::optional(corner) : std::nullopt;
    if (word[0] != '/') return {};
    word.remove_prefix(1);
  }
  return {};
}

/// Is there that one of `count`, counted from 1, or backwards from -1?
bool isThere(std::int64_t number, std::int64_t count) {
  return number != 0 && number <= count && number >= -count;
}

class ObjCheck {
 public:
  ObjCheck(const std::string& file, std::string_view bytes, std::string_view lines, WarningsByKind& warnings)
      : file_(file), bytes_(bytes), lines_(lines), warnings_(warnings) {}

  ObjNames check() {
    forEachLine(lines_, [&](std::string_view text) {
      checkBudget();
      line(text);
    });
    return std::move(names_);
  }

 private:
  void line(std::string_view text) {
    if (const std::size_t comment = text.find('#'); comment != text.npos) text = text.substr(0, comment);
    LineWords words(text);
    const std::string_view key = words.next();
    if (key == "v") {
      point(text, words);
      ++points_;
    } else if (key == "vn") {
      numbers(text, words, key, 3, 3);
      ++normals_;
    } else if (key == "vt") {
      numbers(text, words, key, 1, 3);
      ++uvs_;
    } else if (key == "f")
      face(key, words);
    else
      other(key, words);
  }

  void other(std::string_view key, LineWords words) {
    if (key == "usemtl") {
      const std::string_view name = words.rest();
      if (name.empty()) return warn(key, "usemtl: expected the name of a material");
      names_.materials.try_emplace(std::string(name), offsetOf(name));
    }
    if (key == "mtllib") names_.materialFiles.emplace_back(words.rest(), offsetOf(words.rest()));
    if (key.empty() || listed(kDrawn, key) || listed(kSilent, key)) return;
    if (listed(kThin, key)) return warn(key, "points and lines are left out");
    if (listed(kCurved, key)) return warn(key, "curves and surfaces are left out");
    warn(key, "\"" + std::string(key.substr(0, 40)) + "\" is not known and is skipped");
  }

  /// Three numbers, perhaps with a weight or a colour or both.
  void point(std::string_view text, LineWords words) {
    const int count = numbers(text, words, "v", 3, 7);
    if (count >= 6) color(words, count);
    if (count < 6 && !names_.colors.empty()) names_.colors.push_back({1, 1, 1});
    if (count == 5) warn(text, "v: expected 3 numbers, found 5; the last two are ignored");
  }

  /// The last three of the numbers; those of points before it that have none are white.
  void color(LineWords words, int count) {
    for (int i = 3; i < count; ++i) words.next();
    Vec3f color;
    for (float* channel : {&color.x, &color.y, &color.z})
      *channel = static_cast<float>(parseNumber(words.next())->value);
    names_.colors.resize(points_, {1, 1, 1});
    names_.colors.push_back(color);
  }

  int numbers(std::string_view text, LineWords words, std::string_view key, int least, int most) {
    int count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count)
      if (!isFloat(word)) fail(word, notAFloat(word));
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
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
      const std::optional<CornerNumbers> corner = cornerOf(word);
      if (!corner)
        fail(word, "expected a corner such as 7, 7/8, 7//9 or 7/8/9, found \"" +
                       std::string(word.substr(0, 40)) + "\"");
      if (!isThere(corner->point, points_))
        fail(word,
             "the face uses point " + std::string(word.substr(0, std::min(word.find('/'), 40ul))) +
                 ", but there " + (points_ == 1 ? "is " : "are ") + counted(points_, "point") + " so far",
             "points are counted from 1, or backwards from -1");
      const bool all = (corner->uv == 0 || isThere(corner->uv, uvs_)) &&
                       (corner->normal == 0 || isThere(corner->normal, normals_));
      if (!all) warn(word, "normals or uv that the file does not have are left out");
    }
    if (count < 3) warn(key, "a face of fewer than 3 points is left out");
  }

  void warn(std::string_view at, std::string what) {
    if (!warnings_.again(what)) warnings_.warn(place(at), std::move(what));
  }
  [[noreturn]] void fail(std::string_view at, std::string what, std::string hint = {}) const {
    throw Error(Fault::scene, place(at), std::move(what), std::move(hint));
  }
  std::size_t offsetOf(std::string_view at) const {
    return static_cast<std::size_t>(at.data() - lines_.data());
  }
  Place place(std::string_view at) const { return placeAt(file_, bytes_, offsetOf(at)); }

  const std::string& file_;
  std::string_view bytes_, lines_;
  WarningsByKind& warnings_;
  ObjNames names_;
  std::int64_t points_ = 0, uvs_ = 0, normals_ = 0;  ///< how many so far
};

}  // namespace

ObjNames checkObjLines(const std::string& file, std::string_view bytes, std::string_view lines,
                       WarningsByKind& warnings) {
  return ObjCheck(file, bytes, lines, warnings).check();
}

}  // namespace trace
