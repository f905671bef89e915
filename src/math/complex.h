// Complex numbers. Those of the C++ library divide and take roots differently from one system to another.
#pragma once

#include "math/elementary.h"

namespace trace {

struct Complex {
  Real re = 0, im = 0;
};

constexpr Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
constexpr Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
constexpr Complex operator*(const Complex& a, const Complex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
constexpr Complex operator*(Real s, const Complex& a) { return {s * a.re, s * a.im}; }
constexpr Complex operator/(const Complex& a, const Complex& b) {
  const Real square = b.re * b.re + b.im * b.im;
  return {(a.re * b.re + a.im * b.im) / square, (a.im * b.re - a.re * b.im) / square};
}

inline Real abs(const Complex& a) { return math::hypot(a.re, a.im); }
inline Real arg(const Complex& a) { return math::atan2(a.im, a.re); }
/// The root whose real part is not negative.
inline Complex sqrt(const Complex& a) {
  const Real half = std::sqrt((abs(a) + std::abs(a.re)) / 2), other = half > 0 ? a.im / (2 * half) : 0;
  return a.re < 0 ? Complex{std::abs(other), std::copysign(half, a.im)} : Complex{half, other};
}

}  // namespace trace
