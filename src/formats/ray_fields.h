// Values of .ray files read into the members of scene structs, by the structs' own lists of fields.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/text.h"
#include "formats/ray_findings.h"
#include "formats/ray_syntax.h"
#include "geometry/heights.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace::rayfile {

/// Each reads one value of the field `name`; reports what else was found and returns false.
bool read(Findings& findings, std::string_view name, const Item& value, Real& to);
bool read(Findings& findings, std::string_view name, const Item& value, int& to);
bool read(Findings& findings, std::string_view name, const Item& value, bool& to);
bool read(Findings& findings, std::string_view name, const Item& value, Vec3& to);
bool read(Findings& findings, std::string_view name, const Item& value, Color& to);
/// A word, or a number as written.
bool read(Findings& findings, std::string_view name, const Item& value, std::string& to);

/// The name of a picture beside the scene, which is read.
bool read(Findings& findings, std::string_view name, const Item& value, Heights& to);

/// What read() reads as the same value; with `digits` digits that count, if that is not 0.
std::string written(Real value, int digits);
std::string written(bool value, int digits);
std::string written(int value, int digits);
std::string written(const Vec3& value, int digits);
std::string written(const Color& value, int digits);
std::string written(const std::string& value, int digits);
std::string written(const Heights& value, int digits);
template <class Enum>
requires std::is_enum_v<Enum> std::string written(Enum value, int) {
  return std::string(names(Enum{})[static_cast<std::size_t>(value)]);
}
template <class Sequence>
std::string writtenList(const Sequence& values, int digits);
template <std::size_t N>
std::string written(const std::array<Real, N>& values, int digits) {
  return writtenList(values, digits);
}
template <class Element>
std::string written(const std::vector<Element>& values, int digits) {
  return writtenList(values, digits);
}
template <class Sequence>
std::string writtenList(const Sequence& values, int digits) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "(" : ", ") + written(value, digits);
  return text.empty() ? "()" : text + ")";
}

/// One of an enum's names, which names(Enum) lists.
template <class Enum>
requires std::is_enum_v<Enum>
bool read(Findings& findings, std::string_view name, const Item& value, Enum& to) {
  const auto all = names(Enum{});
  std::string list;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (value.is(Kind::word) && value.text() == all[i]) return to = static_cast<Enum>(i), true;
    list += (i == 0 ? "" : i + 1 == all.size() ? " or " : ", ") + std::string(all[i]);
  }
  return findings.expected(value, name, list, value.is(Kind::word) ? didYouMean(value.text(), all) : ""),
         false;
}

/// What an element of a list looks like.
inline std::string form(const std::string&) { return "\"text\""; }
inline std::string form(Real) { return "number"; }
inline std::string form(const Color&) { return "(red, green, blue)"; }
template <std::size_t N>
std::string form(const std::array<Real, N>&) {
  std::string numbers = "(a";
  for (std::size_t i = 1; i < N; ++i) numbers += std::string(", ") + static_cast<char>('a' + i);
  return numbers + ")";
}
template <class Element>
std::string form(const std::vector<Element>&) {
  return "(" + form(Element{}) + ", " + form(Element{}) + ", ...)";
}

template <std::size_t N>
bool read(Findings& findings, std::string_view name, const Item& value, std::array<Real, N>& to) {
  if (numbers(value, to.data(), static_cast<int>(N))) return true;
  return findings.expected(value, name, form(to)), false;
}
/// A list in brackets, of tuples of numbers or of lists.
template <class Element>
bool read(Findings& findings, std::string_view name, const Item& value, std::vector<Element>& to) {
  if (!value.is(Kind::tuple)) return findings.expected(value, name, "a list " + form(to)), false;
  std::vector<Element> list;
  for (const Item item : value) {
    list.emplace_back();
    if (!read(findings, name, item, list.back())) return false;
  }
  to = std::move(list);
  return true;
}

/// Exactly `count` numbers in a tuple; no report.
bool numbers(const Item& tuple, Real* to, int count);

/// The keyword that `word` is a synonym of, or `word`.
std::string_view canonical(std::string_view word);

/// Reads `field`'s value into the member of that keyword. False if Struct has no such field.
template <class Struct>
bool assignField(Findings& findings, Struct& target, const Item& field) {
  const std::string_view key = canonical(field.key());
  bool found = false;
  forEachField<Struct>([&](const auto& f) {
    if (f.keyword != key) return;
    found = true;
    // Objects are read as objects, materials as materials.
    if constexpr (
        !requires { (target.*f.member).list(); } && !requires { (target.*f.member).indices; })
      read(findings, f.keyword, field.value(), target.*f.member);
  });
  return found;
}

/// Warns, as for a person, that a number is outside its range.
void warnOfRange(Findings& findings, std::string_view owner, std::string_view name, double least, double most,
                 double value, const Item& at);

/// Warns if the field of that keyword is outside its range; the value stays.
template <class Struct>
void checkRange(Findings& findings, const Struct& target, const Item& field) {
  const std::string_view key = canonical(field.key());
  const auto check = [&](const auto& f, Real number) {
    if (number < f.least || number > f.most)
      warnOfRange(findings, Struct::kKeyword, f.keyword, f.least, f.most, number, field);
  };
  forEachField<Struct>([&](const auto& f) {
    if (f.keyword != key) return;
    const auto& value = target.*f.member;
    if constexpr (requires { value.x; })
      check(f, value.x), check(f, value.y), check(f, value.z);
    else if constexpr (requires { value.r; })
      check(f, value.r), check(f, value.g), check(f, value.b);
    else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Real> ||
                       std::is_same_v<std::remove_cvref_t<decltype(value)>, int>)
      check(f, value);
  });
}

/// The keywords of Struct's fields, and more.
template <class Struct>
std::vector<std::string_view> keywords(std::initializer_list<std::string_view> more = {}) {
  std::vector<std::string_view> words(more);
  forEachField<Struct>([&](const auto& f) { words.push_back(f.keyword); });
  return words;
}

}  // namespace trace::rayfile
