// The functions that are used more rarely, from the parts of the others.
#include "math/elementary.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "math/elementary/parts.h"

namespace trace::math {
namespace {

template <std::size_t N>
Real sumOfSquares(const std::array<Real, N>& v) {
  DoubleDouble sum;
  for (const Real x : v) {
    const DoubleDouble square = exactProduct(x, x), next = exactSum(sum.high, square.high);
    sum = {next.high, sum.low + next.low + square.low};
  }
  return rounded(sum);
}

template <std::size_t N>
Real lengthOf(std::array<Real, N> v) {
  Real largest = 0;
  bool isNumber = true;
  for (Real& x : v) {
    x = std::abs(x);
    if (x == kInfinity) return x;
    isNumber = isNumber && x == x;
    largest = std::max(largest, x);
  }
  if (!isNumber) return kNan;
  const bool isUsual = 0x1p-480 < largest && largest < 0x1p500;
  if (isUsual) return std::sqrt(sumOfSquares(v));
  const Real scale = largest > 1 ? 0x1p-600 : 0x1p600;
  for (Real& x : v) x *= scale;
  return std::sqrt(sumOfSquares(v)) / scale;
}

/// erfc of x from 3/4 up
Real tailOf(Real x) {
  if (x > 28) return 0;
  const Real t = (x - 3) / (x + 3);
  const Real p = polynomial(
      t, {-0x1.d8f06dfac798dp-3,  0x1.9596c92adafecp-4,   -0x1.4f64aa4aa2294p-7, -0x1.8600d914617aep-6,
          0x1.67c18994f25f0p-6,   -0x1.3f82b5d08b3acp-7,  0x1.a84c55e74ef61p-10, 0x1.5297b772b7edcp-11,
          -0x1.81214204310afp-12, -0x1.58ccdb8e38e85p-16, 0x1.d6c3e73286721p-15, -0x1.96694ec16d609p-20,
          -0x1.2db14deb26e13p-17, 0x1.16e6d767b2519p-22,  0x1.ab657ab5fa3a5p-20, 0x1.07e7e3f1529e0p-24,
          -0x1.4262d9c97bacdp-22, -0x1.81f2f2068650ep-25, 0x1.f6cfa0ff88da4p-25, 0x1.727eb5c2b9b4fp-27,
          -0x1.619297fabba47p-27, 0x1.81fc902c9d8d5p-31});
  const DoubleDouble square = exactProduct(x, x), sum = quickSum(0x1.6e9827d229d2dp-1, t * p);
  constexpr int kSpare = 100;  // the exponential may be too small for a double
  return rounded(longExp(-square.high, -square.low, kSpare) * (sum / exactSum(1, x))) * 0x1p-100;
}

/// erf of |x| below 3/4
DoubleDouble middleOf(Real x) {
  const Real z = x * x;
  const DoubleDouble product = exactProduct(x, 0x1.20dd750429b6dp+0);
  return {product.high,
          product.low +
              x * (0x1.1ae3a914fed80p-56 +
                   z * polynomial(z, {-0x1.812746b0379e2p-2, 0x1.ce2f21a0425cbp-4, -0x1.b82ce3125b72ep-6,
                                      0x1.565bcd03fb9a7p-8, -0x1.c02db13b5b182p-11, 0x1.f9a2b2525c84ap-14,
                                      -0x1.f4c60cdc49bafp-17, 0x1.b910b4d7cdf75p-20, -0x1.565abef630a6cp-23,
                                      0x1.8a6acfcf86ffbp-27}))};
}

}  // namespace

Real sinh(Real x) {
  const Real size = std::abs(x);
  if (!(size >= 0x1p-28)) return x;
  if (size > 22) return std::copysign(size < 720 ? rounded(longExp(size, 0, -1)) : kInfinity, x);
  const DoubleDouble t = longExpm1(size);
  return std::copysign(rounded(t + t / (DoubleDouble{1} + t)) / 2, x);
}

Real cosh(Real x) {
  const Real size = std::abs(x);
  if (size > 22) return size < 720 ? rounded(longExp(size, 0, -1)) : kInfinity;
  const Real e = exp(size);
  return (e + 1 / e) / 2;
}

Real tanh(Real x) {
  const Real size = std::abs(x);
  if (!(size >= 0x1p-28)) return x;
  if (size > 22) return std::copysign(1, x);
  const DoubleDouble t = longExpm1(2 * size);
  return std::copysign(rounded(t / (DoubleDouble{2} + t)), x);
}

Real asinh(Real x) {
  const Real size = std::abs(x);
  if (!(size >= 0x1p-28) || size == kInfinity) return x;
  if (size > 0x1p28) return std::copysign(rounded(longLog(size) + kLn2), x);
  return std::copysign(log1p(size + size * size / (1 + std::sqrt(1 + size * size))), x);
}

Real acosh(Real x) {
  if (!(x >= 1)) return kNan;
  if (x == kInfinity) return x;
  if (x > 0x1p28) return rounded(longLog(x) + kLn2);
  const DoubleDouble square = exactProduct(x, x) - DoubleDouble{1};
  if (square.high == 0) return 0;
  const Real root = std::sqrt(square.high);
  const DoubleDouble length = exactProduct(root, root), rest = square - length;
  const DoubleDouble sum = DoubleDouble{x} + quickSum(root, rest.high / (2 * root));
  return rounded(longLog(sum.high, sum.low));
}

Real atanh(Real x) {
  const Real size = std::abs(x);
  if (!(size >= 0x1p-28)) return x;
  return std::copysign(log1p(2 * size / (1 - size)) / 2, x);
}

Real cbrt(Real x) {
  if (x == 0 || !(std::abs(x) < kInfinity)) return x;
  const bool isNormal = std::abs(x) >= std::numeric_limits<Real>::min();
  const auto bits = bitCast<std::uint64_t>(std::abs(isNormal ? x : x * 0x1p54));
  const int exponent = static_cast<int>(bits >> 52) - (isNormal ? 0 : 54) + 3000 - 1023, third = exponent / 3;
  const auto withExponent = [](std::uint64_t mantissa, int e) {
    return bitCast<Real>((mantissa & 0x000fffffffffffffu) | static_cast<std::uint64_t>(1023 + e) << 52);
  };
  const Real m = withExponent(bits, exponent % 3);  // from 1 to 8
  const Real guess = polynomial(m, {0x1.412cf4cac6988p-1, 0x1.cbf8c6bac29b9p-2, -0x1.57235039d2da2p-4,
                                    0x1.3a0943b1a883bp-7, -0x1.c51446612731dp-12});
  // Halley's step takes the error to its third power.
  const Real guessCubed = guess * guess * guess;
  const Real root = upperHalf(guess * (guessCubed + 2 * m) / (2 * guessCubed + m));
  const DoubleDouble cube = exactProduct(root * root, root);
  const Real rest = (m - cube.high) - cube.low;
  return std::copysign((root + root * rest / (2 * cube.high + m)) * withExponent(0, third - 1000), x);
}

Real hypot(Real x, Real y) { return lengthOf<2>({x, y}); }
Real hypot(Real x, Real y, Real z) { return lengthOf<3>({x, y, z}); }

Real erf(Real x) {
  const Real size = std::abs(x);
  if (!(size >= 0.75)) return size < 0x1p-1000 ? x * 0x1.20dd750429b6dp+0 : rounded(middleOf(x));
  return std::copysign(size > 6 ? 1 : 1 - tailOf(size), x);
}

Real erfc(Real x) {
  if (!(std::abs(x) >= 0.75)) {
    const DoubleDouble below = middleOf(x), rest = quickSum(1, -below.high);
    return rest.high + (rest.low - below.low);
  }
  return x > 0 ? tailOf(x) : x < -6 ? 2 : 2 - tailOf(-x);
}

Real logGamma(Real x) {
  if (!(x > 0) || x == kInfinity) return x == 0 || x == kInfinity ? kInfinity : kNan;
  DoubleDouble below{1};  // gamma(x) = gamma(x + n) / (x (x + 1) ... (x + n - 1))
  DoubleDouble z{x};
  for (; z.high < 12; z = z + DoubleDouble{1}) below = below * z;
  // Stirling's series
  const Real inverse = 1 / z.high;
  const Real rest =
      inverse * polynomial(inverse * inverse, {1.0 / 12, -1.0 / 360, 1.0 / 1260, -1.0 / 1680, 1.0 / 1188,
                                               -691.0 / 360360, 1.0 / 156, -3617.0 / 122400});
  const DoubleDouble log = longLog(z.high, z.low);
  const DoubleDouble sum =
      (z - DoubleDouble{0.5}) * log - z + DoubleDouble{0x1.d67f1c864beb4p-1, 0x1.4d252f2400510p-54};
  const DoubleDouble all = sum + DoubleDouble{rest};
  return rounded(below.high == 1 ? all : all - longLog(below.high, below.low));
}

}  // namespace trace::math
