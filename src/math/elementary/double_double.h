// Numbers of about 106 bits as sums of two doubles (Dekker, A floating-point technique for extending the
// available precision, Numerische Mathematik 18, 1971), for the elementary functions and their tables. All is
// constexpr and uses only + - * / of doubles. So it has the same bits everywhere.
#pragma once

#include "base/bits.h"
#include "math/vec.h"

namespace trace {

/// The number high + low, where low is at most half a unit in the last place of high.
struct DoubleDouble {
  Real high = 0, low = 0;
};

/// a + b exactly, where |a| >= |b| or a + b is a double.
constexpr DoubleDouble quickSum(Real a, Real b) {
  const Real sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b exactly (Knuth).
constexpr DoubleDouble exactSum(Real a, Real b) {
  const Real sum = a + b, shareOfB = sum - a;
  return {sum, (a - (sum - shareOfB)) + (b - shareOfB)};
}

/// x without the lower 27 of its 53 bits.
constexpr Real upperHalf(Real x) {
  return bitCast<Real>(bitCast<std::uint64_t>(x) & ~std::uint64_t{0x7ffffff});
}

/// a * b, except for the last of its 106 bits.
constexpr DoubleDouble exactProduct(Real a, Real b) {
  const Real product = a * b, aHigh = upperHalf(a), bHigh = upperHalf(b), aLow = a - aHigh, bLow = b - bHigh;
  return {product, ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow};
}

constexpr DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
constexpr DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum = exactSum(a.high, b.high);
  return quickSum(sum.high, sum.low + (a.low + b.low));
}
constexpr DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
constexpr DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = exactProduct(a.high, b.high);
  return quickSum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
constexpr DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const Real quotient = a.high / b.high;
  const DoubleDouble product = exactProduct(quotient, b.high);
  const Real rest = ((a.high - product.high) - product.low) + (a.low - quotient * b.low);
  return quickSum(quotient, rest / b.high);
}

constexpr Real rounded(const DoubleDouble& a) { return a.high + a.low; }

/// c[0] + c[1] x + c[2] x^2 + ... by Horner's rule, for even and odd powers apart: a processor works on both at once.
template <int N>
constexpr Real polynomial(Real x, const Real (&c)[N]) {
  static_assert(N >= 3);
  const Real square = x * x;
  Real last = c[N - 1], other = c[N - 2];
  for (int i = N - 3; i >= 0; --i) {
    const Real next = last * square + c[i];
    last = other;
    other = next;
  }
  return other + x * last;
}

}  // namespace trace
