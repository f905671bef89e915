#include "formats/ray/read/fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/files/file.h"
#include "base/text.h"
#include "formats/ies.h"
#include "formats/ray/read/texture.h"
#include "formats/ray/syntax/names.h"
#include "formats/textures.h"
#include "image/codecs/codec.h"
#include "image/codecs/picture_name.h"

namespace trace::rayfile {

bool numbers(const Item& tuple, Real* to, int count) {
  if (!tuple.is(Kind::tuple)) return false;
  int n = 0;
  for (const Item item : tuple) {
    if (n == count || !item.is(Kind::number)) return false;
    to[n++] = item.number();
  }
  return n == count;
}

bool isLiteral(const Item& number) {
  const std::optional<ParsedNumber> parsed = parseNumber(number.source());
  return parsed && parsed->length == number.source().size();
}

bool read(Findings& findings, std::string_view name, const Item& value, Real& to) {
  if (!value.is(Kind::number)) {
    findings.expected(value, name, "a number");
    return false;
  }
  to = value.number();
  return true;
}

bool read(Findings& findings, std::string_view name, const Item& value, int& to) {
  if (value.is(Kind::number) && !fitsInt(value.number())) {
    findings.expected(value, name,
                      "a whole number from " + toText(-kMostWhole) + " to " + toText(kMostWhole));
    return false;
  }
  if (!value.is(Kind::number) || value.number() != std::floor(value.number())) {
    findings.expected(value, name, "a whole number");
    return false;
  }
  to = static_cast<int>(value.number());
  return true;
}

bool read(Findings& findings, std::string_view name, const Item& value, bool& to) {
  const auto says = [&](std::string_view a, std::string_view b) {
    return value.is(Kind::word) && (value.text() == a || value.text() == b);
  };
  const bool yes = says("true", "on");
  if (!yes && !says("false", "off")) {
    findings.expected(value, name, "true or false");
    return false;
  }
  to = yes;
  return true;
}

/// `none` without quotes: no file.
bool readFileName(Findings& findings, std::string_view name, const Item& value, std::string& to) {
  if (!read(findings, name, value, to)) return false;
  if (value.source() == "none") to.clear();
  return true;
}

bool read(Findings& findings, std::string_view name, const Item& value, Pixels& to) {
  if (!readFileName(findings, name, value, to.file)) return false;
  to.place = findings.syntax().shortPlace(value.offset());
  return true;
}

bool read(Findings& findings, std::string_view name, const Item& value, FormulaText& to) {
  std::string text;
  if (!read(findings, name, value, text)) return false;
  try {
    to = FormulaText(std::move(text));
    return true;
  } catch (const Error& error) {
    findings.error(value, std::string(name) + ": " + error.messages().front().what,
                   error.messages().front().hint);
    return false;
  }
}

std::string written(const FormulaText& value, int digits) { return written(value.text(), digits); }

std::string written(const Pixels& value, int) { return exactly(value.file); }

bool read(Findings& findings, std::string_view name, const Item& value, Vec3& to) {
  Real n[3];
  if (!numbers(value, n, 3)) {
    findings.expected(value, name, "(x, y, z)");
    return false;
  }
  to = {n[0], n[1], n[2]};
  return true;
}

bool read(Findings& findings, std::string_view name, const Item& value, Color& to) {
  Real n[3];
  if (value.is(Kind::number))
    n[0] = n[1] = n[2] = value.number();  // a grey
  else if (!numbers(value, n, 3)) {
    findings.expected(value, name, "(red, green, blue)",
                      value.is(Kind::call)   ? didYouMean(value.key(), textureKinds())
                      : value.is(Kind::word) ? "(1, 1, 1) is white, and #ff8000, as on web pages, orange"
                                             : "");
    return false;
  }
  to = {n[0], n[1], n[2]};
  return true;
}

bool read(Findings& findings, std::string_view name, const Item& value, std::string& to) {
  if (!value.is(Kind::word) && !value.is(Kind::number)) {
    findings.expected(value, name, "a name");
    return false;
  }
  to = value.is(Kind::word) ? value.text() : isLiteral(value) ? value.source() : toText(value.number());
  return true;
}

bool read(Findings& findings, std::string_view name, const Item& value, EnumValue& to) {
  const auto all = to.names();
  std::string list;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (value.is(Kind::word) && value.text() == all[i]) {
      to.set(i);
      return true;
    }
    list += (i == 0 ? "" : i + 1 == all.size() ? " or " : ", ") + std::string(all[i]);
  }
  findings.expected(value, name, list, value.is(Kind::word) ? didYouMean(value.text(), all) : "");
  return false;
}

namespace {

template <class Any>
bool assignTo(Findings& findings, Any& target, const Item& field, std::string_view key) {
  bool found = false;
  editEachField(target, [&](const auto& f, auto& value) {
    if (f.keyword != key) return;
    found = true;
    readField(findings, f, field.value(), value);
  });
  return found;
}

template <class Any>
void checkRangeOf(Findings& findings, const Any& target, const Item& field, std::string_view key,
                  std::string_view owner) {
  forEachField(target, [&](const auto& f, const auto& value) {
    if (f.keyword == key) checkRange(findings, owner, f, value, field);
  });
}

}  // namespace

bool assignField(Findings& findings, Shape& target, const Item& field) {
  return assignTo(findings, target, field, canonical(field.key(), target.keyword()));
}
bool assignField(Findings& findings, MaterialModel& target, const Item& field) {
  return assignTo(findings, target, field, canonical(field.key()));
}
bool assignField(Findings& findings, Light& target, const Item& field) {
  return assignTo(findings, target, field, canonical(field.key()));
}
bool assignField(Findings& findings, TextureModel& target, const Item& field) {
  return assignTo(findings, target, field, canonical(field.key()));
}

void checkRange(Findings& findings, const Shape& target, const Item& field) {
  checkRangeOf(findings, target, field, canonical(field.key(), target.keyword()), target.keyword());
}
void checkRange(Findings& findings, const Light& target, const Item& field) {
  checkRangeOf(findings, target, field, canonical(field.key()), target.keyword());
}
void checkRange(Findings& findings, const MaterialModel& target, const Item& field, std::string_view owner) {
  checkRangeOf(findings, target, field, canonical(field.key()), owner);
}
void checkRange(Findings& findings, const TextureModel& target, const Item& field, std::string_view owner) {
  checkRangeOf(findings, target, field, canonical(field.key()), owner);
}

std::string written(Real value, int digits) {
  if (!std::isfinite(value))
    throw Error(Fault::scene, "a number that is not finite cannot be written to a .ray file");
  std::string text;
  appendNumber(text, value, digits);
  return text;
}

std::string written(bool value, int) { return value ? "true" : "false"; }

std::string written(int value, int) { return std::to_string(value); }

std::string written(const Vec3& v, int digits) {
  return "(" + written(v.x, digits) + ", " + written(v.y, digits) + ", " + written(v.z, digits) + ")";
}

std::string written(const Color& c, int digits) { return written(Vec3{c.r, c.g, c.b}, digits); }

std::string written(const std::string& value, int) {
  std::string text = "\"";
  for (char c : value) text += isHeld(c) ? c : c == '"' ? '\'' : ' ';
  return text.substr(0, Syntax::kLongestWord - 1) + "\"";
}

std::string exactly(const std::string& name) {
  if (isSayable(name)) return written(name, 0);
  const Unsayable file{name, true};
  throw Error(Fault::scene, file.why(), file.hint());
}

namespace {

/// The luminance of linear Rec. 709.
float brightness(const Color& c) { return static_cast<float>(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b); }

}  // namespace

bool read(Findings& findings, std::string_view name, const Item& value, Heights& to) {
  constexpr int kMostSide = 4096;
  std::string file;
  if (!read(findings, name, value, file)) return false;
  if (file.empty()) {
    to = {};
    return true;
  }
  try {
    const std::string bytes =
        readBeside(findings.syntax().file(), pictureName(file).file, findings.scene().inputs);
    const Picture picture = decodePicture(bytes, file);
    if (const std::string remark = pictureRemark(bytes, file); !remark.empty())
      findings.warn(value, "\"" + file + "\": " + remark);
    if (min(picture.width, picture.height) < 2 || max(picture.width, picture.height) > kMostSide) {
      findings.error(value, std::string(name) + ": expected a picture of 2 to " + std::to_string(kMostSide) +
                                " pixels along each side");
      return false;
    }
    auto grid = std::make_shared<HeightGrid>(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y)  // the picture's first row is the farthest
      for (int x = 0; x < picture.width; ++x)
        grid->at(x, picture.height - 1 - y) = brightness(picture.at(x, y));
    to = {file, std::move(grid)};
    return true;
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    findings.error(value, error.messages().front().what, error.messages().front().hint);
    return false;
  }
}

bool read(Findings& findings, std::string_view name, const Item& value, PhotometryFile& to) {
  std::string file;
  if (!readFileName(findings, name, value, file)) return false;
  to = {file, nullptr, findings.syntax().shortPlace(value.offset())};
  if (file.empty()) return true;
  const std::string path = pictureFile(findings.syntax().file(), file);
  try {
    const std::string bytes = readBeside("", path, findings.scene().inputs);
    Messages messages;
    to.data = std::make_shared<const Photometry>(readIes(path, bytes, messages));
    for (const Message& message : messages.all()) findings.warn(value, message.what, message.hint);
    return true;
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    const Message& first = error.messages().front();
    const std::string at = first.place.line > 0 ? placeText(first.place) + ": " : "";
    findings.error(value, std::string(name) + ": " + at + first.what, first.hint);
    return false;
  }
}

std::string written(const PhotometryFile& value, int) { return exactly(value.file); }

std::string written(const Heights& value, int) { return exactly(value.file); }

std::string_view canonical(std::string_view word) {
  if (word == "colour") return "color";
  if (word == "trimesh" || word == "mesh") return "polymesh";
  if (word == "subtraction") return "difference";
  if (word == "quaternion") return "quaternian";  // the misspelling is the real keyword
  return word;
}

std::string_view canonical(std::string_view word, std::string_view shape) {
  if (shape == "torus" && word == "a") return "major_radius";
  if (shape == "torus" && word == "b") return "minor_radius";
  return canonical(word);
}

namespace {

/// A colour as picture programs give it: three whole numbers from 0 to 255, of which one is above 1.
std::optional<std::array<Real, 3>> bytesOf(const Item& value) {
  std::array<Real, 3> c;
  const auto isByte = [](Real x) { return x >= 0 && x <= 255 && x == std::floor(x); };
  if (!numbers(value, c.data(), 3) || !std::all_of(c.begin(), c.end(), isByte)) return {};
  if (*std::max_element(c.begin(), c.end()) <= 1) return {};
  return c;
}

/// How the language writes that colour.
std::string writtenBytes(const std::array<Real, 3>& c) {
  char hex[32];
  std::snprintf(hex, sizeof hex, "#%02x%02x%02x", static_cast<unsigned>(c[0]), static_cast<unsigned>(c[1]),
                static_cast<unsigned>(c[2]));
  std::string text = std::string(hex) + ", or srgb(";
  for (const Real x : c) text += (text.back() == '(' ? "" : ", ") + toText(x) + "/255";
  return text + ")";
}

}  // namespace

void warnOfBytes(Findings& findings, std::string_view owner, const Item& field) {
  constexpr Real kBright = 128, kWhite = 255;
  if (!findings.isOfKind()) return;
  const auto bytes = bytesOf(field.value());
  if (!bytes) return;
  const auto [least, most] = std::minmax_element(bytes->begin(), bytes->end());
  if (*most < kBright || (*least == *most && *most != kWhite)) return;  // a strong light
  findings.warn(field,
                std::string(field.key()) + " of " + std::string(owner) + ": " +
                    std::string(field.value().source()) + " is " + toText(*most) +
                    " times as bright as a usual one",
                "that colour of a picture program is " + writtenBytes(*bytes));
}

void warnOfRange(Findings& findings, std::string_view owner, std::string_view name, double least, double most,
                 double value, const Item& at) {
  const std::string field = std::string(name) + " of " + std::string(owner);
  const std::string range =
      most == kNoLimit ? "at least " + toText(least) : toText(least) + " to " + toText(most);
  const bool ofBytes = value > 1 && value <= 255 && most == 1 && at.keyed() && at.value().is(Kind::tuple);
  const auto bytes = ofBytes ? bytesOf(at.value()) : std::nullopt;
  findings.warn(at, field + ": expected " + range + ", found " + toText(value),
                bytes     ? "a colour goes from 0 to 1; that of a picture program is " + writtenBytes(*bytes)
                : ofBytes ? "a colour goes from 0 to 1; #ff8000 is one as picture programs write it"
                          : "",
                "range: " + field);
}

}  // namespace trace::rayfile
