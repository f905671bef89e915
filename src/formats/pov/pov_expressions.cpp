// Expressions: numbers, vectors, colours, strings, and the functions of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/text.h"
#include "formats/pov/pov_reader.h"
#include "math/elementary.h"

namespace trace::pov {
namespace {

constexpr int kMostDepth = 120;

struct Deeper {
  int& depth;
  ~Deeper() { --depth; }
};

/// How tightly an operator binds; -1 for none.
int strength(const Token& t, bool compares) {
  if (!t.is(Token::Kind::mark)) return -1;
  const char c = t.text[0];
  if (c == '*' || c == '/') return 4;
  if (c == '+' || c == '-') return 3;
  if (!compares) return -1;
  if (c == '<' || c == '>' || c == '=' || t.text == "!=") return 2;
  if (c == '&') return 1;
  if (c == '|') return 0;
  return -1;
}

bool isColorWord(std::string_view w) {
  return w == "color" || w == "colour" || w == "rgb" || w == "rgbf" || w == "rgbt" || w == "rgbft" ||
         w == "srgb" || w == "srgbf" || w == "srgbt" || w == "srgbft";
}

std::optional<int> componentNamed(std::string_view w) {
  constexpr std::string_view kNames[]{"red", "green", "blue", "filter", "transmit"};
  constexpr std::string_view kAxes[]{"x", "y", "z"};
  for (int i = 0; i < 5; ++i)
    if (w == kNames[i]) return i;
  for (int i = 0; i < 3; ++i)
    if (w == kAxes[i]) return i;
  if (w == "u") return 0;
  if (w == "v") return 1;
  if (w == "t") return 3;
  return {};
}

Real linearOf(Real c) { return c <= 0.04045 ? c / 12.92 : math::pow((c + 0.055) / 1.055, 2.4); }

/// Words of animations, whose value depends on whether the scene is part of one.
bool isOfAnimations(std::string_view w) {
  return w == "clock_delta" || w == "final_frame" || w == "initial_frame" || w == "final_clock" ||
         w == "frame_number";
}

std::optional<Real> constantNamed(std::string_view w) {
  if (w == "pi") return kPi;
  if (w == "tau") return 2 * kPi;
  if (w == "true" || w == "yes" || w == "on") return 1;
  if (w == "false" || w == "no" || w == "off") return 0;
  if (isOfAnimations(w) || w == "initial_clock" || w == "clock_on") return 0;
  if (w == "image_width") return 640;
  if (w == "image_height") return 480;
  if (w == "now") return 0;
  return {};
}

std::optional<Vec3> axisNamed(std::string_view w) {
  if (w == "x") return Vec3{1, 0, 0};
  if (w == "y") return Vec3{0, 1, 0};
  if (w == "z") return Vec3{0, 0, 1};
  return {};
}

bool isStringFunction(std::string_view w) {
  return w == "concat" || w == "str" || w == "vstr" || w == "chr" || w == "substr" || w == "strupr" ||
         w == "strlwr" || w == "datetime";
}

bool isVectorFunction(std::string_view w) {
  return w == "vaxis_rotate" || w == "vcross" || w == "vdot" || w == "vlength" || w == "vnormalize" ||
         w == "vrotate" || w == "vturbulence";
}

bool isOtherFunction(std::string_view w) {
  return w == "rand" || w == "seed" || w == "strcmp" || w == "strlen" || w == "val" || w == "asc" ||
         w == "dimensions" || w == "dimension_size" || w == "defined" || w == "file_exists" ||
         w == "select" || w == "min" || w == "max" || w == "inside" || w == "trace" || w == "min_extent" ||
         w == "max_extent";
}

std::string formatted(Real value, int width, int digits) {
  char buffer[400];
  const bool zeros = width < 0;
  width = std::min(std::abs(width), 100);
  if (digits < 0)
    std::snprintf(buffer, sizeof buffer, zeros ? "%0*f" : "%*f", width, value);
  else
    std::snprintf(buffer, sizeof buffer, zeros ? "%0*.*f" : "%*.*f", width, std::min(digits, 30), value);
  return buffer;
}

}  // namespace

// --- numbers ---

Numbers Reader::expression(bool compares) {
  if (++depth_ > kMostDepth) {
    depth_ = 0;
    fail(peek(), "expressions within each other more than " + std::to_string(kMostDepth) + " deep");
  }
  const Deeper deeper{depth_};
  const Numbers value = binary(compares ? 0 : 3, unary(compares), compares);
  if (!peek().isMark("?")) return value;
  next();
  const Numbers a = expression(compares);
  expectMark(":", "between the two values of a ?");
  const Numbers b = expression(compares);
  return value[0] != 0 ? a : b;
}

Numbers Reader::binary(int least, Numbers left, bool compares) {
  for (;;) {
    const Token op = peek();
    const int binds = strength(op, compares);
    if (binds < least) return left;
    next();
    Numbers right = unary(compares);
    while (strength(peek(), compares) > binds) right = binary(binds + 1, right, compares);
    const std::optional<Numbers> result = combined(op.text, left, right);
    if (!result)
      fail(op,
           op.text == "/" ? "a division by zero" : "\"" + std::string(op.text) + "\" is no operator here");
    left = *result;
  }
}

Numbers Reader::unary(bool compares) {
  if (takesMark("-")) {
    Numbers value = unary(compares);
    for (Real& c : value.v) c = -c;
    return value;
  }
  if (takesMark("+")) return unary(compares);
  if (takesMark("!")) return Numbers(unary(compares)[0] == 0);
  return postfix(primary());
}

Numbers Reader::postfix(Numbers value) {
  while (peek().isMark(".")) {
    next();
    const Token name = next();
    if (name.isName("gray") || name.isName("grey")) {
      value = Numbers(0.297 * value[0] + 0.589 * value[1] + 0.114 * value[2]);
      continue;
    }
    const auto i = componentNamed(name.text);
    if (!i) fail(name, "expected x, y, z, red, green, blue ... after \".\", found " + describe(name));
    value = Numbers(value.promoted(5)[*i]);
  }
  return value;
}

Numbers Reader::vectorLiteral() {
  Numbers value;
  value.size = 0;
  const Token open = next();
  while (!peek().isMark(">")) {
    if (value.size == 5) expected("\">\" after five components");
    value[value.size++] = number();
    comma();
  }
  next();
  if (value.size < 2) fail(open, "a vector of less than two components");
  return value;
}

Numbers Reader::primary() {
  const Token t = peek();
  if (t.is(Token::Kind::number)) {
    next();
    return Numbers(t.number);
  }
  if (t.isMark("(")) {
    next();
    const Numbers value = expression(true);
    expectMark(")", "after the expression");
    return value;
  }
  if (t.isMark("<")) return vectorLiteral();
  if (startsText()) {  // two strings are compared
    const std::string a = text();
    const Token op = next();
    const std::string b = text();
    if (op.isMark("=")) return Numbers(a == b);
    if (op.isMark("!=")) return Numbers(a != b);
    if (op.isMark("<")) return Numbers(a < b);
    if (op.isMark(">")) return Numbers(a > b);
    fail(op, "expected = or != between two strings, found " + describe(op));
  }
  if (t.is(Token::Kind::name)) {
    if (isColorWord(t.text)) return color();
    if (Value* value = valueOf(t)) {
      if (value->as<Numbers>() || value->as<std::shared_ptr<Array>>() || value->as<Ref<Formula>>() ||
          value->as<std::shared_ptr<SplineCurve>>()) {
        next();
        const Slot slot = namedSlot(t);
        if (const auto* n = slot ? slot->as<Numbers>() : nullptr) return *n;
        if (const auto* f = slot ? slot->as<Ref<Formula>>() : nullptr) {
          std::vector<Real> given;
          const Ref<Formula> function = *f;
          expectMark("(", "after the function's name");
          while (!peek().isMark(")")) {
            const Numbers a = expression(true);
            const bool alone = (*f)->parameters.size() >= 2 && given.empty() && peek().isMark(")");
            for (int i = 0; i < (alone ? std::max(1, a.size) : 1); ++i) given.push_back(a[i]);
            if (!takesMark(",")) break;
          }
          expectMark(")", "after the arguments");
          if (function->transform || function->pigment) {
            given.resize(3);
            const Vec3 p{given[0], given[1], given[2]};
            if (function->transform) return Numbers(*function->transform * p);
            return colorAt(function->pigment, p);
          }
          const std::optional<Real> result = (*f)->at(given.data(), static_cast<int>(given.size()));
          if (!result) fail(t, "\"" + std::string(t.text) + "\" has no value there");
          return Numbers(*result);
        }
        if (const auto* s = slot ? slot->as<std::shared_ptr<SplineCurve>>() : nullptr) {
          expectMark("(", "after the spline's name");
          const Real at = number(true);
          SplineCurve curve = **s;
          if (takesMark(",")) {
            const Token kind = next();
            curve.kind = kind.isName("linear_spline")      ? SplineCurve::Kind::linear
                         : kind.isName("quadratic_spline") ? SplineCurve::Kind::quadratic
                         : kind.isName("cubic_spline")     ? SplineCurve::Kind::cubic
                                                           : SplineCurve::Kind::natural;
          }
          expectMark(")", "after the number");
          return curve.at(at);
        }
        fail(t, "expected a number, found " + std::string(slot ? kindOf(*slot) : "nothing") + " called \"" +
                    std::string(t.text) + "\"");
      }
      fail(t, "expected a number, found " + std::string(kindOf(*value)) + " called \"" + std::string(t.text) +
                  "\"");
    }
    if (const auto axis = axisNamed(t.text)) {
      next();
      return Numbers(*axis);
    }
    if (t.isName("t")) {
      next();
      Numbers value;
      value.v = {0, 0, 0, 1, 0};
      value.size = 4;
      return value;
    }
    if (t.isName("u") || t.isName("v")) {
      next();
      Numbers value;
      value.v = {t.isName("u") ? 1.0 : 0.0, t.isName("v") ? 1.0 : 0.0, 0, 0, 0};
      value.size = 2;
      return value;
    }
    if (t.isName("clock")) {
      next();
      return Numbers(time_.now());
    }
    if (t.isName("version")) {
      next();
      return Numbers(world_.version);
    }
    if (isOfAnimations(t.text)) {
      next();
      asksFrame_ = true;
      return Numbers(frame_);
    }
    if (const auto constant = constantNamed(t.text)) {
      next();
      return Numbers(*constant);
    }
    if (isVectorFunction(t.text) || isOtherFunction(t.text) || findNumberFunction(t.text)) {
      next();
      return call(t);
    }
    if (const auto i = componentNamed(t.text); i && *i < 5) {  // as in `color red 1`
      return color();
    }
    std::vector<std::string_view> names;
    for (const Scope& scope : scopes_)
      for (const auto& [name, slot] : scope) names.emplace_back(name);
    std::sort(names.begin(), names.end());  // always the same of two that are equally near
    std::string hint;
    if (names.size() < 5000) hint = didYouMean(t.text, names);
    fail(t, "expected a number, found \"" + std::string(t.text) + "\", which is not declared", hint);
  }
  expected("a number");
}

Value* Reader::valueOf(const Token& name) {
  Slot* slot = find(name.text);
  return slot && *slot ? slot->get() : nullptr;
}

/// After its name was read: with the elements that brackets choose.
Slot Reader::namedSlot(const Token& name) {
  Slot* slot = find(name.text);
  if (!slot) return {};
  Slot chosen = *slot;
  while (chosen && chosen->as<std::shared_ptr<Array>>() && peek().isMark("[")) {
    next();
    const int i = whole();
    expectMark("]", "after the index");
    const Array& a = **chosen->as<std::shared_ptr<Array>>();
    if (i < 0 || static_cast<std::size_t>(i) >= a.elements.size())
      fail(name,
           "index " + std::to_string(i) + " of \"" + std::string(name.text) + "\", which has " +
               std::to_string(a.elements.size()) + " elements",
           "the first index is 0");
    chosen = a.elements[static_cast<std::size_t>(i)];
    if (!chosen || chosen->none())
      fail(name, "element " + std::to_string(i) + " of \"" + std::string(name.text) + "\" has no value yet");
  }
  return chosen;
}

Real Reader::number(bool compares) {
  const Token at = peek();
  const Numbers n = expression(compares);
  if (!std::isfinite(n[0])) fail(at, "a number that is not finite");
  return n[0];
}

Vec3 Reader::vector() {
  const Token at = peek();
  const Vec3 v = expression().vec();
  if (!isFinite(v)) fail(at, "a vector that is not finite");
  return v;
}

int Reader::whole() {
  const Token at = peek();
  const Real n = number();
  if (!(std::abs(n) < 2e9)) fail(at, "expected a whole number, found " + std::to_string(n));
  return static_cast<int>(std::floor(n + 1e-9));
}

/// After a word such as `hollow`: on by itself.
bool Reader::flag() {
  if (startsNumber() && !peek().isMark("<") && !peek().isMark("-")) {
    const Token& t = peek();
    if (t.is(Token::Kind::number) || constantNamed(t.text) || t.isMark("(")) return number() != 0;
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr; value && value->as<Numbers>())
      return number() != 0;
  }
  return true;
}

bool Reader::startsNumber() {
  const Token& t = peek();
  if (t.is(Token::Kind::number) || t.isMark("(") || t.isMark("<") || t.isMark("-") || t.isMark("+") ||
      t.isMark("!"))
    return true;
  if (!t.is(Token::Kind::name)) return false;
  if (const Value* value = valueOf(t))
    return value->as<Numbers>() || value->as<Ref<Formula>>() || value->as<std::shared_ptr<SplineCurve>>() ||
           value->as<std::shared_ptr<Array>>();
  return isColorWord(t.text) || axisNamed(t.text) || constantNamed(t.text) || isVectorFunction(t.text) ||
         isOtherFunction(t.text) || findNumberFunction(t.text) || t.text == "clock" || t.text == "version" ||
         t.text == "u" || t.text == "v" || t.text == "t";
}

Numbers Reader::color() {
  Numbers c = Numbers().promoted(5);
  bool any = false;
  const Token first = peek();
  for (;;) {
    const Token t = peek();
    if (any && t.is(Token::Kind::name) && isColorWord(t.text)) break;
    if (t.isName("color") || t.isName("colour")) {
      next();
      continue;
    }
    if (t.is(Token::Kind::name) && isColorWord(t.text)) {
      next();
      Numbers given = expression();
      const std::string_view kind = t.text[0] == 's' ? t.text.substr(1) : t.text;
      if (given.size == 1) given = given.promoted(kind == "rgb" ? 3 : kind == "rgbft" ? 5 : 4);
      if (t.text[0] == 's')
        for (int i = 0; i < 3; ++i)
          given[i] = world_.gamma > 0 && world_.gamma != 1 ? given[i] : linearOf(given[i]);
      c = Numbers().promoted(5);
      for (int i = 0; i < 3; ++i) c[i] = given[i];
      if (kind == "rgbf") c[3] = given[3];
      if (kind == "rgbt") c[4] = given[3];
      if (kind == "rgb") c[3] = given.size > 3 ? given[3] : 0, c[4] = given.size > 4 ? given[4] : 0;
      if (kind == "rgbft") c[3] = given[3], c[4] = given[4];
      any = true;
      continue;
    }
    if (t.is(Token::Kind::name) && !valueOf(t)) {
      constexpr std::string_view kNames[]{"red", "green", "blue", "filter", "transmit", "alpha"};
      const auto* const name = std::find(std::begin(kNames), std::end(kNames), t.text);
      if (name != std::end(kNames)) {
        next();
        const auto i = static_cast<int>(name - kNames);
        c[i == 5 ? 3 : i] = number();
        any = true;
        continue;
      }
    }
    if (!any && startsNumber()) {
      const Numbers given = expression();
      if (given.size == 1)
        for (int i = 0; i < 3; ++i) c[i] = given[0];
      else
        for (int i = 0; i < given.size; ++i) c[i] = given[i];
      any = true;
      continue;
    }
    break;
  }
  if (!any) expected("a colour, such as rgb <1, 0.5, 0>");
  for (const Real part : c.v)
    if (!std::isfinite(part)) fail(first, "a colour that is not finite");
  return c;
}

Color Reader::plainColor() {
  const Numbers c = color();
  return {c[0], c[1], c[2]};
}

Numbers Reader::call(const Token& name) {
  const std::string_view f = name.text;
  expectMark("(", "after the function's name");
  const auto end = [&](Numbers value) {
    expectMark(")", "after the arguments of " + std::string(f));
    return value;
  };
  const auto vec = [&] {
    const Vec3 v = expression(true).vec();
    comma();
    return v;
  };
  if (f == "vcross") {
    const Vec3 a = vec(), b = vec();
    return end(Numbers(cross(a, b)));
  }
  if (f == "vdot") {
    const Vec3 a = vec(), b = vec();
    return end(Numbers(dot(a, b)));
  }
  if (f == "vlength") return end(Numbers(length(vec())));
  if (f == "vnormalize") {
    const Vec3 a = vec();
    const Real l = length(a);
    return end(Numbers(l > 0 ? a / l : a));
  }
  if (f == "vrotate") {
    Vec3 a = vec();
    const Vec3 by = vec();
    for (int i = 0; i < 3; ++i) {
      Vec3 axis;
      axis[i] = 1;
      a = Affine::rotation(axis, by[i] * kPi / 180) * a;
    }
    return end(Numbers(a));
  }
  if (f == "vaxis_rotate") {
    const Vec3 a = vec(), axis = vec();
    const Real angle = number(true), l = length(axis);
    return end(Numbers(l > 0 ? Affine::rotation(axis / l, angle * kPi / 180) * a : a));
  }
  if (f == "vturbulence") {
    const Real lambda = number(true);
    comma();
    const Real omega = number(true);
    comma();
    const int octaves = std::clamp(whole(), 1, 10);
    comma();
    const Vec3 p = vec();
    Vec3 sum = noiseVectorAt(p);
    Real l = lambda, o = omega;
    for (int i = 2; i <= octaves; ++i, l *= lambda, o *= omega) sum += noiseVectorAt(p * l) * o;
    return end(Numbers(sum));
  }
  if (f == "seed") {
    seeds_.push_back(static_cast<std::uint64_t>(static_cast<std::int64_t>(number(true))));
    return end(Numbers(static_cast<Real>(seeds_.size() - 1)));
  }
  if (f == "rand") {
    const int stream = whole();
    if (stream < 0 || static_cast<std::size_t>(stream) >= seeds_.size())
      fail(name, "rand() of a stream that seed() did not make", "#declare R = seed(1); then rand(R)");
    return end(Numbers(nextRandom(seeds_[static_cast<std::size_t>(stream)])));
  }
  if (f == "strlen") return end(Numbers(static_cast<Real>(text().size())));
  if (f == "val") return end(Numbers(std::atof(text().c_str())));
  if (f == "asc") {
    const std::string s = text();
    return end(Numbers(s.empty() ? 0 : static_cast<unsigned char>(s[0])));
  }
  if (f == "strcmp") {
    const std::string a = text();
    comma();
    const std::string b = text();
    return end(Numbers(a < b ? -1 : a > b ? 1 : 0));
  }
  if (f == "file_exists") {
    text();
    return end(Numbers(0));
  }
  if (f == "dimensions" || f == "dimension_size") {
    const Token of = next();
    const Slot slot = namedSlot(of);
    const auto* array = slot ? slot->as<std::shared_ptr<Array>>() : nullptr;
    if (!array) fail(of, "expected an array, found " + describe(of));
    if (f == "dimensions") return end(Numbers(static_cast<Real>((*array)->sizes.size())));
    comma();
    const int d = whole();
    const auto& sizes = (*array)->sizes;
    if (d < 1 || static_cast<std::size_t>(d) > sizes.size())
      fail(of, "an array without a dimension " + std::to_string(d));
    return end(Numbers(static_cast<Real>(sizes[static_cast<std::size_t>(d - 1)])));
  }
  if (f == "defined") return end(Numbers(isDefined(raw())));
  if (f == "select") {
    const Numbers a = expression(true);
    std::vector<Numbers> rest;
    while (takesMark(",")) rest.push_back(expression(true));
    if (rest.size() < 2 || rest.size() > 3) fail(name, "select() takes three or four arguments");
    if (rest.size() == 2) return end(a[0] < 0 ? rest[0] : rest[1]);
    return end(a[0] < 0 ? rest[0] : a[0] == 0 ? rest[1] : rest[2]);
  }
  if (f == "trace" || f == "inside" || f == "min_extent" || f == "max_extent") return end(query(name));
  std::vector<Real> given;
  while (!peek().isMark(")")) {
    given.push_back(number(true));
    if (!takesMark(",")) break;
  }
  const NumberFunction* function = findNumberFunction(f);
  if (!function || static_cast<int>(given.size()) < std::abs(function->arguments))
    fail(name, std::string(f) + "() has too few arguments");
  const std::optional<Real> value = function->value(given.data(), static_cast<int>(given.size()));
  if (!value || !std::isfinite(*value)) fail(name, std::string(f) + "() has no value there");
  return end(Numbers(*value));
}

// --- strings ---

bool Reader::startsText() {
  const Token& t = peek();
  if (t.is(Token::Kind::string)) return true;
  if (!t.is(Token::Kind::name)) return false;
  if (isStringFunction(t.text)) return true;
  const Value* value = valueOf(t);
  return value && value->as<std::string>();
}

std::string Reader::text() {
  constexpr std::size_t kLongest = 1 << 20;
  const Token t = peek();
  if (t.is(Token::Kind::string)) {
    next();
    return unescaped(t.text);
  }
  if (t.is(Token::Kind::name)) {
    if (isStringFunction(t.text)) {
      next();
      std::string result = stringFunction(t);
      if (result.size() > kLongest) fail(t, "a string longer than a million characters");
      return result;
    }
    if (valueOf(t)) {
      next();
      const Slot slot = namedSlot(t);
      if (const auto* s = slot ? slot->as<std::string>() : nullptr) return *s;
      fail(t, "expected a string, found " + std::string(slot ? kindOf(*slot) : "nothing"));
    }
  }
  expected("a string");
}

std::string Reader::stringFunction(const Token& name) {
  const std::string_view f = name.text;
  expectMark("(", "after the function's name");
  std::string result;
  if (f == "concat") {
    while (!peek().isMark(")")) {
      result += text();
      if (!takesMark(",")) break;
    }
  } else if (f == "str") {
    const Real value = number(true);
    comma();
    const int width = whole();
    comma();
    result = formatted(value, width, whole());
  } else if (f == "vstr") {
    const int count = std::clamp(whole(), 1, 5);
    comma();
    const Numbers value = expression(true).promoted(5);
    comma();
    const std::string between = text();
    comma();
    const int width = whole();
    comma();
    const int digits = whole();
    for (int i = 0; i < count; ++i) result += (i ? between : "") + formatted(value[i], width, digits);
  } else if (f == "chr") {
    result = std::string(1, static_cast<char>(whole() & 255));
  } else if (f == "substr") {
    const std::string whole_ = text();
    comma();
    const int from = whole();
    comma();
    const int count = whole();
    if (from < 1 || count < 0 || static_cast<std::size_t>(from - 1) > whole_.size())
      fail(name, "substr() beyond the string", "the first character is number 1");
    result = whole_.substr(static_cast<std::size_t>(from - 1), static_cast<std::size_t>(count));
  } else if (f == "strupr" || f == "strlwr") {
    result = text();
    for (char& c : result) {
      if (f == "strupr" && c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
      if (f == "strlwr" && c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    }
  } else {  // datetime: the same picture whenever it is rendered
    number(true);
    if (takesMark(",")) text();
    result = "1970-01-01 00:00:00Z";
  }
  expectMark(")", "after the arguments of " + std::string(f));
  return result;
}

// --- values of any kind ---

Value Reader::arrayValue() {
  constexpr std::size_t kMostElements = 10'000'000;
  const Token at = peek();
  std::vector<std::size_t> sizes;
  while (takesMark("[")) {
    const int n = whole();
    expectMark("]", "after the size");
    if (n < 1 || static_cast<std::size_t>(n) > kMostElements)
      fail(at, "an array of " + std::to_string(n) + " elements");
    sizes.push_back(static_cast<std::size_t>(n));
  }
  const bool open = sizes.empty();
  if (sizes.size() > 5) fail(at, "an array of more than five dimensions");
  std::size_t total = 1;
  for (const std::size_t n : sizes) {
    total *= n;
    if (total > kMostElements) fail(at, "an array of more than 10 million elements");
  }
  const auto make = [&](auto&& self, std::size_t level) -> std::shared_ptr<Array> {
    auto array = std::make_shared<Array>();
    array->sizes.assign(sizes.begin() + static_cast<std::ptrdiff_t>(level), sizes.end());
    array->elements.resize(sizes[level]);
    if (level + 1 < sizes.size())
      for (Slot& e : array->elements) e = std::make_shared<Value>(Value{self(self, level + 1)});
    return array;
  };
  if (open) {
    auto array = std::make_shared<Array>();
    if (takesMark("{")) {
      while (!peek().isMark("}")) {
        array->elements.push_back(std::make_shared<Value>(anyValue(false)));
        comma();
      }
      next();
    }
    array->sizes = {array->elements.size()};
    return Value{array};
  }
  const std::shared_ptr<Array> array = make(make, 0);
  const auto fill = [&](auto&& self, Array& to, std::size_t level) -> void {
    expectMark("{", "before the elements");
    std::size_t i = 0;
    while (!peek().isMark("}")) {
      if (i == to.elements.size()) expected("\"}\" after " + std::to_string(i) + " elements");
      if (level + 1 < sizes.size())
        self(self, **to.elements[i]->as<std::shared_ptr<Array>>(), level + 1);
      else
        to.elements[i] = std::make_shared<Value>(anyValue(false));
      ++i;
      comma();
    }
    next();
  };
  if (peek().isMark("{")) fill(fill, *array, 0);
  return Value{array};
}

std::shared_ptr<SplineCurve> Reader::spline() {
  expectMark("{", "after spline");
  auto curve = std::make_shared<SplineCurve>();
  while (!peek().isMark("}")) {
    const Token t = peek();
    if (t.isName("linear_spline") || t.isName("quadratic_spline") || t.isName("cubic_spline") ||
        t.isName("natural_spline")) {
      next();
      curve->kind = t.isName("linear_spline")      ? SplineCurve::Kind::linear
                    : t.isName("quadratic_spline") ? SplineCurve::Kind::quadratic
                    : t.isName("cubic_spline")     ? SplineCurve::Kind::cubic
                                                   : SplineCurve::Kind::natural;
      comma();
      continue;
    }
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr)
      if (const auto* other = value->as<std::shared_ptr<SplineCurve>>()) {
        *curve = **other;
        next();
        comma();
        continue;
      }
    const Real at = number();
    comma();
    curve->points[at] = expression();
    comma();
  }
  next();
  return curve;
}

Value Reader::anyValue(bool compares) {
  const Token t = peek();
  if (t.is(Token::Kind::name) && !valueOf(t)) {
    const std::string_view w = t.text;
    if (w == "array") return next(), arrayValue();
    if (w == "function") return next(), Value{function()};
    if (w == "spline") return next(), Value{spline()};
    if (w == "transform") return next(), Value{transformBlock()};
    if (w == "pigment" || w == "density")
      return next(), Value{pigment(w == "density" ? "density_map" : "pigment_map")};
    if (w == "normal") return next(), Value{normal()};
    if (w == "finish") return next(), Value{finish()};
    if (w == "interior") return next(), Value{interior()};
    if (w == "material") return next(), Value{material()};
    if (w == "media") return next(), Value{std::make_shared<const MediaNode>(media())};
    if (w == "camera") return next(), Value{std::make_shared<const CameraNode>(camera())};
    if (w == "fog") return next(), Value{std::make_shared<const FogNode>(fog())};
    if (w == "sky_sphere") return next(), Value{std::make_shared<const SkyNode>(skySphere())};
    if (w == "color_map" || w == "colour_map" || w == "pigment_map" || w == "texture_map" ||
        w == "normal_map" || w == "slope_map" || w == "density_map")
      return next(), Value{map(t)};
    if (w == "texture" || w == "interior_texture") {
      auto whole_ = std::make_shared<TextureNode>();
      while (peek().isName("texture")) {
        next();
        const Ref<TextureNode> one = texture();
        whole_->layers.insert(whole_->layers.end(), one->layers.begin(), one->layers.end());
      }
      return Value{Ref<TextureNode>(whole_)};
    }
    if (w == "rainbow") {
      leaveOut(t, "a rainbow");
      next();
      omitBlock();
      return Value{};
    }
  }
  if (t.is(Token::Kind::string) || startsText()) return Value{text()};
  if (t.is(Token::Kind::name)) {
    if (valueOf(t)) {
      const auto held = [&](const Value& v) {
        return !v.as<Numbers>() && !v.as<Ref<Formula>>() && !v.as<std::shared_ptr<SplineCurve>>();
      };
      if (valueOf(t)->as<std::shared_ptr<Array>>()) {
        // An element may be a number, where an expression begins.
        const Token name = next();
        const Slot slot = namedSlot(name);
        if (!slot) fail(name, "\"" + std::string(name.text) + "\" has no value");
        if (const auto* n = slot->as<Numbers>()) {
          const Numbers value = binary(compares ? 0 : 3, postfix(*n), compares);
          if (!peek().isMark("?")) return Value{value};
          next();
          const Numbers a = expression(true);
          expectMark(":", "between the two values of a ?");
          const Numbers b = expression(true);
          return Value{value[0] != 0 ? a : b};
        }
        if (const auto* inner = slot->as<std::shared_ptr<Array>>())
          return Value{std::make_shared<Array>(**inner)};
        return *slot;
      }
      if (held(*valueOf(t))) {
        const Value value = *valueOf(t);
        next();
        return value;
      }
      if ((valueOf(t)->as<Ref<Formula>>() || valueOf(t)->as<std::shared_ptr<SplineCurve>>()) &&
          !rawPeek().isMark("(")) {
        const Frame& frame = frames_.back();
        if (frame.at >= frame.end || !frame.source->tokens[frame.at].isMark("(")) {
          const Value value = *valueOf(t);
          next();
          return value;
        }
      }
    } else if (startsObject()) {
      return Value{Ref<Node>(object())};
    }
    if (isColorWord(t.text)) {
      const Numbers c = color();
      return Value{binary(compares ? 0 : 3, c, compares)};
    }
  }
  return Value{expression(compares)};
}

}  // namespace trace::pov
