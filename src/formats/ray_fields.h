// Values of .ray files read into the members of scene structs, by the structs' own lists of fields.
#pragma once

#include <string_view>
#include <vector>

#include "base/field.h"
#include "formats/ray_findings.h"
#include "formats/ray_syntax.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace::rayfile {

/// Each reads one value of the field `name`; reports what else was found and returns false.
bool read(Findings& findings, std::string_view name, const Item& value, Real& to);
bool read(Findings& findings, std::string_view name, const Item& value, bool& to);
bool read(Findings& findings, std::string_view name, const Item& value, Vec3& to);
bool read(Findings& findings, std::string_view name, const Item& value, Color& to);
/// A word, or a number as written.
bool read(Findings& findings, std::string_view name, const Item& value, std::string& to);

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
    if constexpr (!requires { (target.*f.member).list(); })  // objects are read as objects
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
    else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Real>)
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
