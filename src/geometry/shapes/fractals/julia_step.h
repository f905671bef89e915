// The steps of Julia sets that are powers, of one number of four dimensions or of four such numbers in the
// lanes of one: T is a Real or a simd::Double4. Quaternions follow from |q|^2 and the real part a alone:
// q^2 = 2 a q - |q|^2.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "math/vec.h"

namespace trace {

/// The function that is iterated.
enum class Iteration {
  square,        ///< quaternions: the square
  cube,          ///< quaternions: the cube
  hypercomplex,  ///< the square of commutative hypercomplex numbers, i^2 = j^2 = -1, k = ij
  sine,          ///< quaternions: the sine
  exponential,   ///< quaternions: the exponential
};
constexpr std::array<std::string_view, 5> names(Iteration) {
  return {"square", "cube", "hypercomplex", "sine", "exponential"};
}

namespace julia {

/// |a b| <= kStretch |a| |b| for hypercomplex numbers, which have divisors of zero.
constexpr Real kStretch = 1.4142135623730951;

template <class T>
struct Number {
  T a, i, j, k;
};
template <class T>
Number<T> operator+(const Number<T>& p, const Number<T>& q) {
  return {p.a + q.a, p.i + q.i, p.j + q.j, p.k + q.k};
}
template <class T>
Number<T> operator*(const Number<T>& p, const T& s) {
  return {p.a * s, p.i * s, p.j * s, p.k * s};
}
template <class T>
T dot(const Number<T>& p, const Number<T>& q) {
  return (p.a * q.a + p.i * q.i) + (p.j * q.j + p.k * q.k);
}
template <class T>
Number<T> lessReal(const Number<T>& q, const T& s) {
  return {q.a - s, q.i, q.j, q.k};
}
template <class T>
T twice(const T& x) {
  return x + x;
}
template <class T>
T constant(Real x) {
  if constexpr (std::is_same_v<T, Real>)
    return x;
  else
    return T::all(x);
}
template <class T>
Number<T> hypercomplexProduct(const Number<T>& p, const Number<T>& q) {
  return {p.a * q.a - p.i * q.i - p.j * q.j + p.k * q.k, p.a * q.i + p.i * q.a - p.j * q.k - p.k * q.j,
          p.a * q.j + p.j * q.a - p.i * q.k - p.k * q.i, p.a * q.k + p.k * q.a + p.i * q.j + p.j * q.i};
}

/// The step, of a number whose square |q|^2 is known.
template <Iteration kIteration, class T>
Number<T> step(const Number<T>& q, const T& square) {
  if constexpr (kIteration == Iteration::hypercomplex) return hypercomplexProduct(q, q);
  const T a = twice(q.a);
  const Number<T> r = lessReal(q * a, square);
  if constexpr (kIteration == Iteration::cube) return r * a + q * (square - twice(square));
  return r;
}

/// How the step changes as q does by d, where |q|^2 and q . d are known.
template <Iteration kIteration, class T>
Number<T> slope(const Number<T>& q, const Number<T>& d, const T& square, const T& product) {
  if constexpr (kIteration == Iteration::hypercomplex) {
    const Number<T> r = hypercomplexProduct(q, d);
    return r + r;
  }
  const T a = twice(q.a), b = twice(d.a), both = twice(product);
  const Number<T> r = lessReal(d * a + q * b, both);
  if constexpr (kIteration == Iteration::cube)
    return r * a + lessReal(q * a, square) * b + d * (square - twice(square)) + q * (both - twice(both));
  return r;
}

/// The most that a step stretches at a number of size s.
template <Iteration kIteration, class T>
T stretch(const T& s) {
  if constexpr (kIteration == Iteration::cube) return (s + s + s) * s;
  if constexpr (kIteration == Iteration::hypercomplex) return twice(s) * constant<T>(kStretch);
  return twice(s);
}

/// A bound of the second derivative of a step within w of a place where q is of size s and changes by l, and
/// its second derivative is within m: |q| <= s + w l + w^2 m / 2, |q'| <= l + w m.
template <Iteration kIteration, class T>
T bend(const T& s, const T& l, const T& m, const T& w) {
  const T speed = l + w * m, farthest = s + w * (l + constant<T>(0.5) * (w * m));
  if constexpr (kIteration == Iteration::cube)
    return constant<T>(3) * (farthest * (twice(speed * speed) + farthest * m));
  const T squares = twice(speed * speed + farthest * m);
  return kIteration == Iteration::hypercomplex ? squares * constant<T>(kStretch) : squares;
}

}  // namespace julia
}  // namespace trace
