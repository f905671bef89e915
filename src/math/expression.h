// A small, safe language for formulas in x, y, z, and where a surface is known u, v: numbers, + - * / ^,
// brackets, functions. Parsed once into a list of steps without loops or calls, so that evaluation always
// ends; evaluated along a line over numbers or intervals, with its derivative.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "math/along.h"

namespace trace {

class Expression {
 public:
  static constexpr std::size_t kMostSteps = 256;

  /// The names of the functions, for messages and documentation.
  static std::vector<std::string_view> functions();

  enum class Variables { xyz, xyzuv };

  Expression() = default;
  /// Throws Error(Fault::scene) that says what was expected at which character.
  explicit Expression(std::string_view text, Variables known = Variables::xyz);

  /// At the point o + t d, for a number t, or over all of them for an interval.
  template <class T>
  Along<T> along(const Vec3& o, const Vec3& d, T t, const Vec2& uv = {}) const;

  Real at(const Vec3& p, const Vec2& uv = {}) const { return along<Real>(p, {}, 0, uv).value; }
  Vec3 gradientAt(const Vec3& p) const;
  /// A bound of the rounding error of at(p).
  Real errorAt(const Vec3& p) const;

 private:
  friend class ExpressionParser;
  enum class Do : std::uint8_t {
    number,
    x,
    y,
    z,
    u,
    v,  // leaves
    negate,
    abs,
    square,
    sqrt,
    exp,
    log,
    sin,
    cos,
    tan,  // the last function of one argument
    add,
    subtract,
    multiply,
    divide,
    power,
    root,
    min,
    max,  // functions of two arguments; power: whole exponent; root: real
  };
  struct Step {
    Do what = Do::number;
    std::uint16_t a = 0, b = 0;  ///< earlier steps
    Real number = 0;             ///< or exponent
  };

  std::vector<Step> steps_;  ///< the last is the value
};

}  // namespace trace
