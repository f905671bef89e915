// Values of .ray files read into the members of scene structs, by the structs' own lists of fields.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/field.h"
#include "base/text.h"
#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "geometry/field_value.h"
#include "geometry/shapes/surfaces/heights.h"
#include "math/color.h"
#include "math/vec.h"
#include "shading/formula_text.h"
#include "shading/lights/light.h"
#include "shading/lights/photometry.h"
#include "shading/material.h"
#include "shading/pixels.h"

namespace trace::rayfile {

/// Whole numbers in a file are at most this, and at least minus this.
inline constexpr double kMostWhole = 1e9;
inline bool fitsInt(double number) { return std::abs(number) <= kMostWhole; }

/// Does the file have the number itself, rather than a key or an expression?
bool isLiteral(const Item& number);

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
/// The name of a picture, which is read when the whole scene is.
bool read(Findings& findings, std::string_view name, const Item& value, Pixels& to);
bool read(Findings& findings, std::string_view name, const Item& value, FormulaText& to);
/// The name of a photometric file beside the scene, which is read.
bool read(Findings& findings, std::string_view name, const Item& value, PhotometryFile& to);

/// The text that read() reads as the same value; with `digits` digits that count, if that is not 0.
std::string written(Real value, int digits);
std::string written(bool value, int digits);
std::string written(int value, int digits);
std::string written(const Vec3& value, int digits);
std::string written(const Color& value, int digits);
/// A text with a quotation mark is written as another, as near as can be (ray_names.h).
std::string written(const std::string& value, int digits);
/// The name of a file, which stands for nothing else. Throws Error(Fault::scene) if it cannot be said.
std::string exactly(const std::string& name);
std::string written(const Heights& value, int digits);
std::string written(const Pixels& value, int digits);
std::string written(const FormulaText& value, int digits);
std::string written(const PhotometryFile& value, int digits);
inline std::string written(const EnumValue& value, int) { return std::string(value.name()); }
template <class Enum>
requires std::is_enum_v<Enum> std::string written(Enum value, int digits) {
  return written(EnumValue(value), digits);
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

/// One of the names of an enum.
bool read(Findings& findings, std::string_view name, const Item& value, EnumValue& to);
template <class Enum>
requires std::is_enum_v<Enum>
bool read(Findings& findings, std::string_view name, const Item& value, Enum& to) {
  EnumValue any(to);
  return read(findings, name, value, any);
}

/// The form of an element of a list.
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
  findings.expected(value, name, form(to));
  return false;
}
/// A list in brackets, of tuples of numbers or of lists.
template <class Element>
bool read(Findings& findings, std::string_view name, const Item& value, std::vector<Element>& to) {
  if (!value.is(Kind::tuple)) {
    findings.expected(value, name, "a list " + form(to));
    return false;
  }
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
/// The node of a field of a shape: those that students named otherwise, too.
std::string_view canonical(std::string_view word, std::string_view shape);

/// read() of the value of the field `f`, whose range is said of a whole number that no int can hold.
template <class Field, class Value>
void readField(Findings& findings, const Field& f, const Item& value, Value& to) {
  if constexpr (std::is_same_v<Value, int>)
    if (value.is(Kind::number) && !fitsInt(value.number()) && f.most != kNoLimit)
      return findings.expected(value, f.keyword,
                               "a whole number from " + toText(f.least) + " to " + toText(f.most));
  if (f.unit == "degrees" && value.is(Kind::number) && value.source().ends_with("deg") &&
      !findings.isOfKind())
    return findings.expected(value, f.keyword, "a number of degrees",
                             "write it without deg, which makes radians");
  read(findings, f.keyword, value, to);
}

/// Objects are read as objects, materials as materials.
inline bool read(Findings&, std::string_view, const Item&, Operands&) { return true; }
inline bool read(Findings&, std::string_view, const Item&, MaterialList&) { return true; }

/// Reads `field`'s value into the member of that keyword. False if Struct has no such field.
template <class Struct>
bool assignField(Findings& findings, Struct& target, const Item& field) {
  const std::string_view key = canonical(field.key());
  bool found = false;
  forEachField<Struct>([&](const auto& f) {
    if (f.keyword != key) return;
    found = true;
    readField(findings, f, field.value(), target.*f.member);
  });
  return found;
}
bool assignField(Findings& findings, Shape& target, const Item& field);
bool assignField(Findings& findings, Light& target, const Item& field);
bool assignField(Findings& findings, MaterialModel& target, const Item& field);
bool assignField(Findings& findings, TextureModel& target, const Item& field);

/// Warns, as for a person, that a number is outside its range.
void warnOfRange(Findings& findings, std::string_view owner, std::string_view name, double least, double most,
                 double value, const Item& at);

/// Warns of a colour without an upper limit that is given as picture programs give one, such as (255, 0, 0),
/// in files of the kind `Trace 1`.
void warnOfBytes(Findings& findings, std::string_view owner, const Item& field);

/// Warns if a number of the value is outside the range of the field `f`.
template <class Field, class Value>
void checkRange(Findings& findings, std::string_view owner, const Field& f, const Value& value,
                const Item& at) {
  const auto check = [&](Real number) {
    if (number < f.least || number > f.most)
      warnOfRange(findings, owner, f.keyword, f.least, f.most, number, at);
  };
  if constexpr (requires { value.x; }) {
    check(value.x);
    check(value.y);
    check(value.z);
  } else if constexpr (requires { value.r; }) {
    check(value.r);
    check(value.g);
    check(value.b);
  } else if constexpr (std::is_same_v<Value, Real> || std::is_same_v<Value, int>) {
    check(value);
  }
}

/// Warns if the field of that keyword is outside its range; the value stays.
template <class Struct>
void checkRange(Findings& findings, const Struct& target, const Item& field,
                std::string_view owner = Struct::kKeyword) {
  const std::string_view key = canonical(field.key());
  forEachField<Struct>([&](const auto& f) {
    if (f.keyword == key) checkRange(findings, owner, f, target.*f.member, field);
  });
}
void checkRange(Findings& findings, const Shape& target, const Item& field);
void checkRange(Findings& findings, const Light& target, const Item& field);
void checkRange(Findings& findings, const MaterialModel& target, const Item& field, std::string_view owner);
void checkRange(Findings& findings, const TextureModel& target, const Item& field, std::string_view owner);

/// The keywords of Struct's fields, and more.
template <class Struct>
std::vector<std::string_view> keywords(std::initializer_list<std::string_view> more = {}) {
  std::vector<std::string_view> words(more);
  forEachField<Struct>([&](const auto& f) { words.push_back(f.keyword); });
  return words;
}
template <class Row, class AnyField>
std::vector<std::string_view> keywords(const Listed<Row, AnyField>& listed,
                                       std::initializer_list<std::string_view> more = {}) {
  std::vector<std::string_view> words(more);
  for (const AnyField& field : listed.fields()) words.push_back(field.keyword);
  return words;
}

}  // namespace trace::rayfile
