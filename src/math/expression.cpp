#include "math/expression.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "math/elementary.h"

namespace trace {

// --- parsing ------------------------------------------------------------------------------------------

namespace {
constexpr std::array<std::string_view, 11> kFunctions{"abs", "sqrt", "exp", "log", "sin",      "cos",
                                                      "tan", "min",  "max", "pow", "smoothmin"};
}

std::vector<std::string_view> Expression::functions() { return {kFunctions.begin(), kFunctions.end()}; }

/// sum = product {(+|-) product}; product = factor {(*|/) factor}; factor = [-] power; power = atom [^
/// factor].
class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, bool hasUv, std::vector<Expression::Step>& steps)
      : text_(text), hasUv_(hasUv), steps_(steps) {}

  void parse() {
    sum();
    if (skipBlanks() < text_.size()) fail("expected an operator or the end");
  }

 private:
  using Do = Expression::Do;
  using Index = std::uint16_t;
  static constexpr int kMostDepth = 100;

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Fault::scene,
                "formula: " + what + " at character " + std::to_string(at_ + 1) + ", found " +
                    (at_ < text_.size() ? "\"" + std::string(text_.substr(at_, 12)) + "\"" : "the end"));
  }
  std::size_t skipBlanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_;
  }
  bool take(char c) {
    if (skipBlanks() >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void need(char c) {
    if (!take(c)) fail(std::string("expected \"") + c + "\"");
  }
  Index add(Do what, Index a = 0, Index b = 0, Real number = 0) {
    if (steps_.size() >= Expression::kMostSteps) fail("the formula is too long");
    steps_.push_back({what, a, b, number});
    return static_cast<Index>(steps_.size() - 1);
  }

  Index sum() {
    if (++depth_ > kMostDepth) fail("the formula is nested too deeply");
    Index left = product();
    for (;;) {
      if (take('+'))
        left = add(Do::add, left, product());
      else if (take('-'))
        left = add(Do::subtract, left, product());
      else
        break;
    }
    --depth_;
    return left;
  }
  Index product() {
    Index left = factor();
    for (;;) {
      if (take('*'))
        left = add(Do::multiply, left, factor());
      else if (take('/'))
        left = add(Do::divide, left, factor());
      else
        return left;
    }
  }
  Index factor() {
    if (++depth_ > kMostDepth) fail("the formula is nested too deeply");
    const Index result = take('-') ? add(Do::negate, factor()) : power();
    --depth_;
    return result;
  }
  Index power() {
    const Index base = atom();
    return take('^') ? raised(base, factor()) : base;
  }
  /// The exponent is a number.
  Index raised(Index base, Index exponent) {
    Real e = 0;
    if (steps_[exponent].what == Do::number)
      e = steps_[exponent].number;
    else if (steps_[exponent].what == Do::negate && steps_[steps_[exponent].a].what == Do::number)
      e = -steps_[steps_[exponent].a].number;
    else
      throw Error(Fault::scene, "formula: expected a number as exponent, found a formula before character " +
                                    std::to_string(at_ + 1));
    constexpr Real kMostExponent = 64;
    if (!(std::abs(e) <= kMostExponent))
      throw Error(Fault::scene, "formula: expected an exponent from -64 to 64, found " + toText(e));
    if (e == 2) return add(Do::square, base);
    if (e != std::floor(e)) return add(Do::root, base, 0, e);
    const Index whole = add(Do::power, base, 0, std::abs(e));
    return e >= 0 ? whole : add(Do::divide, add(Do::number, 0, 0, 1), whole);
  }
  Index atom() {
    skipBlanks();
    if (take('(')) {
      const Index inner = sum();
      need(')');
      return inner;
    }
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (at_ < text_.size() && isLetter(text_[at_])) return word();
    if (at_ < text_.size() && text_[at_] != '+' && text_[at_] != '-')
      if (const auto number = parseNumber(text_.substr(at_)); number && std::isfinite(number->value)) {
        at_ += number->length;
        return add(Do::number, 0, 0, number->value);
      }
    fail("expected a number, " + variables() + ", a function or \"(\"");
  }
  std::string variables() const { return hasUv_ ? "x, y, z, u, v" : "x, y, z"; }
  Index word() {
    std::size_t end = at_;
    while (end < text_.size() &&
           ((text_[end] >= 'a' && text_[end] <= 'z') || (text_[end] >= 'A' && text_[end] <= 'Z')))
      ++end;
    const std::string_view name = text_.substr(at_, end - at_);
    if (name == "x" || name == "y" || name == "z") {
      at_ = end;
      return add(name == "x" ? Do::x : name == "y" ? Do::y : Do::z);
    }
    if (hasUv_ && (name == "u" || name == "v")) {
      at_ = end;
      return add(name == "u" ? Do::u : Do::v);
    }
    if (name == "pi") {
      at_ = end;
      return add(Do::number, 0, 0, kPi);
    }
    if (std::find(kFunctions.begin(), kFunctions.end(), name) == kFunctions.end())
      fail("expected " + variables() + ", pi or a function");
    at_ = end;
    need('(');
    const Index a = sum();
    if (name == "min" || name == "max" || name == "pow" || name == "smoothmin") {
      need(',');
      const Index b = sum();
      const Index result = name == "min"   ? add(Do::min, a, b)
                           : name == "max" ? add(Do::max, a, b)
                           : name == "pow" ? raised(a, b)
                                           : smoothMin(a, b);
      need(')');
      return result;
    }
    need(')');
    return add(name == "abs"    ? Do::abs
               : name == "sqrt" ? Do::sqrt
               : name == "exp"  ? Do::exp
               : name == "log"  ? Do::log
               : name == "sin"  ? Do::sin
               : name == "cos"  ? Do::cos
                                : Do::tan,
               a);
  }
  /// smoothmin(a, b, k) = (a + b - sqrt((a - b)^2 + k^2)) / 2: a fillet about k wide where a and b meet.
  Index smoothMin(Index a, Index b) {
    need(',');
    const Index k = sum();
    const Index apart = add(Do::add, add(Do::square, add(Do::subtract, a, b)), add(Do::square, k));
    return add(Do::multiply, add(Do::number, 0, 0, 0.5),
               add(Do::subtract, add(Do::add, a, b), add(Do::sqrt, apart)));
  }

  std::string_view text_;
  bool hasUv_;
  std::vector<Expression::Step>& steps_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(std::string_view text, Variables known) {
  ExpressionParser(text, known == Variables::xyzuv, steps_).parse();
}

// --- evaluation ---------------------------------------------------------------------------------------

namespace {

// The same words for numbers and intervals.
using math::cos, math::exp, math::log, math::sin;
Real square(Real a) { return a * a; }
Real root(Real a) { return std::sqrt(max(a, 0)); }
Interval root(const Interval& a) { return sqrt(a); }
Real wholePower(Real a, int n) { return math::pow(a, n); }
Interval wholePower(const Interval& a, int n) { return power(a, n); }
Real realPower(Real a, Real e) { return math::pow(max(a, 0), e); }
Interval realPower(const Interval& a, Real e) { return power(a, e); }
Real magnitude(Real a) { return std::abs(a); }
Interval magnitude(const Interval& a) { return abs(a); }
Real tangent(Real a) { return math::tan(a); }
Interval tangent(const Interval& a) {
  return a.high - a.low < kPi ? sin(a) / cos(a) : Interval::everything();
}
Real either(Real a, Real) { return a; }
Interval either(const Interval& a, const Interval& b) { return hull(a, b); }
Real unknown(Real) { return 0; }
Interval unknown(const Interval&) { return Interval::everything(); }
bool surelyBelow(Real a, Real b) { return a < b; }
bool surelyBelow(const Interval& a, const Interval& b) { return a.high < b.low; }

}  // namespace

template <class T>
Along<T> Expression::along(const Vec3& o, const Vec3& d, T t, const Vec2& uv) const {
  Along<T> v[kMostSteps];
  if (steps_.empty()) return {T(0), T(0)};
  const T zero(0), one(1);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& s = steps_[i];
    const T a = v[s.a].value, b = v[s.b].value, da = v[s.a].slope, db = v[s.b].slope;
    const auto set = [&](const T& value, const T& slope) { v[i] = {value, slope}; };
    switch (s.what) {
      case Do::number: set(T(s.number), zero); break;
      case Do::x: set(T(o.x) + t * T(d.x), T(d.x)); break;
      case Do::y: set(T(o.y) + t * T(d.y), T(d.y)); break;
      case Do::z: set(T(o.z) + t * T(d.z), T(d.z)); break;
      case Do::u: set(T(uv.x), zero); break;
      case Do::v: set(T(uv.y), zero); break;
      case Do::negate: set(-a, -da); break;
      case Do::abs:
        set(magnitude(a), surelyBelow(zero, a) ? da : surelyBelow(a, zero) ? -da : either(da, -da));
        break;
      case Do::square: set(square(a), T(2) * a * da); break;
      case Do::sqrt: set(root(a), surelyBelow(zero, a) ? da / (T(2) * root(a)) : unknown(a)); break;
      case Do::exp: set(exp(a), exp(a) * da); break;
      case Do::log: set(log(a), surelyBelow(zero, a) ? da / a : unknown(a)); break;
      case Do::sin: set(sin(a), cos(a) * da); break;
      case Do::cos: set(cos(a), -sin(a) * da); break;
      case Do::tan: set(tangent(a), (one + square(tangent(a))) * da); break;
      case Do::add: set(a + b, da + db); break;
      case Do::subtract: set(a - b, da - db); break;
      case Do::multiply: set(a * b, da * b + db * a); break;
      case Do::divide: set(a / b, (da - db * (a / b)) / b); break;
      case Do::power: {
        const int n = static_cast<int>(s.number);
        set(wholePower(a, n), n == 0 ? zero : T(s.number) * wholePower(a, n - 1) * da);
        break;
      }
      case Do::root:
        set(realPower(a, s.number),
            surelyBelow(zero, a) ? T(s.number) * realPower(a, s.number - 1) * da : unknown(a));
        break;
      case Do::min: set(min(a, b), surelyBelow(a, b) ? da : surelyBelow(b, a) ? db : either(da, db)); break;
      case Do::max: set(max(a, b), surelyBelow(b, a) ? da : surelyBelow(a, b) ? db : either(da, db)); break;
    }
  }
  return v[steps_.size() - 1];
}

template Along<Real> Expression::along(const Vec3&, const Vec3&, Real, const Vec2&) const;
template Along<Interval> Expression::along(const Vec3&, const Vec3&, Interval, const Vec2&) const;

Vec3 Expression::gradientAt(const Vec3& p) const {
  return {along<Real>(p, {1, 0, 0}, 0).slope, along<Real>(p, {0, 1, 0}, 0).slope,
          along<Real>(p, {0, 0, 1}, 0).slope};
}

/// The interval of a single point bounds the rounding.
Real Expression::errorAt(const Vec3& p) const {
  const Interval value = along<Interval>(p, {}, 0.0).value;
  const Real error = value.high - value.low;
  return std::isfinite(error) ? error : 0;
}

}  // namespace trace
