// The trigonometric functions and their inverses (Cody and Waite, Software manual for the elementary
// functions, 1980).
#include <array>
#include <cstddef>

#include "math/elementary.h"
#include "math/elementary/parts.h"

namespace trace::math {
namespace {

constexpr DoubleDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr DoubleDouble kWholePi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

/// An angle as a number of quarter turns, of which the last two bits count, and a rest of at most pi / 4.
struct Rest {
  unsigned quarters = 0;
  Real high = 0, low = 0;
};

/// pi / 2 in three parts. The products of the first two with whole numbers below 2^20 are exact.
inline Rest restOf(Real x) {
  const Real shifted = x * 0x1.45f306dc9c883p-1 + 0x1.8p52, n = shifted - 0x1.8p52;
  const Real left = x - n * 0x1.921fb54400000p+0, second = n * 0x1.0b4611a600000p-34;
  const Real high = left - second;
  return {static_cast<unsigned>(bitCast<Bits>(shifted)), high,
          ((left - high) - second) - n * 0x1.3198a2e037073p-69};
}

/// 2 / pi, in 1216 bits
constexpr std::uint32_t kTwoOverPi[] = {
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
    0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
    0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab};

/// Large angles: their product with those bits of 2 / pi that matter (Payne and Hanek, Radian reduction for
/// trigonometric functions, ACM SIGNUM 18, 1983).
Rest restOfLarge(Real x) {
  constexpr int kWords = 7;
  const Bits bits = bitCast<Bits>(x);
  const Bits m = (bits & 0x000fffffffffffffu) | 0x0010000000000000u;
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff) - 1075;  // |x| = m 2^exponent
  const int first = exponent > 2 ? (exponent - 2) / 32 : 0;          // words before it make whole turns
  std::array<std::uint32_t, kWords + 2> product{};                   // from the lowest word
  for (int part = 0; part < 2; ++part) {
    const Bits factor = part == 0 ? m & 0xffffffffu : m >> 32;
    Bits carry = 0;
    for (int i = 0; i < kWords; ++i) {
      std::uint32_t& word = product[static_cast<std::size_t>(i + part)];
      carry += factor * kTwoOverPi[first + kWords - 1 - i] + word;
      word = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product[static_cast<std::size_t>(kWords + part)] += static_cast<std::uint32_t>(carry);
  }
  const int point = 32 * (first + kWords) - exponent;  // so many bits are behind the point
  const auto wordAt = [&](int place) {
    const auto i = static_cast<std::size_t>(place / 32);
    return static_cast<std::uint32_t>(
        (product[i] | (i + 1 < product.size() ? Bits{product[i + 1]} << 32 : 0)) >> place % 32);
  };
  unsigned quarters = wordAt(point) & 3;
  const bool upper = wordAt(point - 32) >> 31;  // the next quarter turn is nearer
  quarters += upper;
  DoubleDouble rest{upper ? -1.0 : 0.0};
  Real weight = 0x1p-32;
  for (int k = 1; k <= 5; ++k, weight *= 0x1p-32) rest = rest + DoubleDouble{wordAt(point - 32 * k) * weight};
  rest = rest * kHalfPi;
  return x < 0 ? Rest{0u - quarters, -rest.high, -rest.low} : Rest{quarters, rest.high, rest.low};
}

/// The sine and cosine of a rest, in two parts each.
struct LongSinCos {
  DoubleDouble sin, cos;
};
inline LongSinCos nearZero(Real r, Real low) {
  const Real z = r * r, z2 = z * z, half = z / 2, almost = 1 - half;
  const Real s = (-0x1.5555555555548p-3 + z * 0x1.111111110f7d0p-7) +
                 z2 * ((-0x1.a01a019bfdc5ep-13 + z * 0x1.71de35678996ap-19) +
                       z2 * (-0x1.ae5e5a3dedb0fp-26 + z * 0x1.5d8fb30e4490bp-33));
  const Real c = (0x1.555555555554cp-5 + z * -0x1.6c16c16c1517fp-10) +
                 z2 * ((0x1.a01a019cb1c78p-16 + z * -0x1.27e4f809f02a6p-22) +
                       z2 * (0x1.1ee9ebe50be59p-29 + z * -0x1.8fae98dc63893p-37));
  return {{r, r * z * s + low * almost}, {almost, ((1 - almost) - half) + (z2 * c - r * low)}};
}

/// The sine of so many quarter turns and the rest.
inline Real turned(const LongSinCos& rest, unsigned quarters) {
  const Real both[]{rounded(rest.sin), rounded(rest.cos)};
  return bitCast<Real>(bitCast<Bits>(both[quarters & 1]) ^ static_cast<Bits>(quarters & 2) << 62);
}

/// An angle that is neither tiny nor large.
inline bool isUsual(Real angle) {
  constexpr Bits kTiny = 0x3e40000000000000u, kLarge = 0x40e0000000000000u;  // 2^-27, 2^15
  return (bitCast<Bits>(angle) & ~(Bits{1} << 63)) - kTiny < kLarge - kTiny;
}

/// An angle that is not usual, nor tiny; if it is infinite the rest is not a number.
Rest restOfUnusual(Real angle) { return std::abs(angle) < kInfinity ? restOfLarge(angle) : Rest{0, kNan, 0}; }

/// The sine of an angle that is not usual, and so many quarter turns.
Real rareSine(Real angle, unsigned quarters) {
  if (std::abs(angle) < 0x1p-27) return quarters == 0 ? angle : 1;
  const Rest r = restOfUnusual(angle);
  return turned(nearZero(r.high, r.low), r.quarters + quarters);
}

/// (asin x - x) / x for |x| up to 1/2
inline Real asinRest(Real x) {
  const Real z = x * x;
  return z * polynomial(
                 z, {0x1.5555555555577p-3, 0x1.333333332e08bp-4, 0x1.6db6db7219fd9p-5, 0x1.f1c71a921b7c9p-6,
                     0x1.6e8bdf3114e7cp-6, 0x1.1c49ea9b7f0bdp-6, 0x1.ca2019d1d31e3p-7, 0x1.7580f79e7db8fp-7,
                     0x1.6156a8d6d167ep-7, 0x1.e46355211955bp-9, 0x1.641927207e6e9p-6, -0x1.58b16033aba4bp-6,
                     0x1.0b80102a8fbc4p-5});
}

/// asin(sqrt((1 - x) / 2)) for x from 1/2 to 1, half of acos(x)
DoubleDouble halfAcos(Real x) {
  const Real square = (1 - x) / 2, root = std::sqrt(square);
  if (root == 0) return {};
  const DoubleDouble product = exactProduct(root, root);
  return {root, ((square - product.high) - product.low) / (2 * root) + root * asinRest(root)};
}

/// The arc tangents of multiples of 1/16 up to 1, by Euler's series of x / (1 + x^2).
constexpr auto arcTangents() {
  std::array<DoubleDouble, 17> table{};
  for (int j = 1; j <= 16; ++j) {
    const DoubleDouble square{Real(j * j)}, share = square / (square + DoubleDouble{256});
    DoubleDouble term = DoubleDouble{Real(16 * j)} / (square + DoubleDouble{256}), sum = term;
    for (int k = 1; k <= 110; ++k) {
      term = term * share * DoubleDouble{Real(2 * k)} / DoubleDouble{Real(2 * k + 1)};
      sum = sum + term;
    }
    table[static_cast<std::size_t>(j)] = sum;
  }
  return table;
}
constexpr std::array<DoubleDouble, 17> kArcTangents = arcTangents();

/// The arc tangent of q from 0 to 1.
DoubleDouble arcTangent(const DoubleDouble& q) {
  const Real x = q.high;
  if (x < 0.125) {
    const Real z = x * x;
    return {x, q.low + x * z *
                           polynomial(z, {-0x1.5555555555555p-2, 0x1.99999999991c7p-3, -0x1.2492492383f9bp-3,
                                          0x1.c71c6f9d46408p-4, -0x1.745be78277419p-4, 0x1.3ab7eef98aa45p-4,
                                          -0x1.029f6657b3ab3p-4})};
  }
  const int step = static_cast<int>(x * 16 + 0.5);
  const Real middle = step / 16.0, t = (x - middle) / (1 + x * middle), z = t * t;
  const DoubleDouble& ofMiddle = kArcTangents[static_cast<std::size_t>(step)];
  const DoubleDouble sum = quickSum(ofMiddle.high, t);
  return {sum.high, sum.low + ofMiddle.low + q.low / (1 + x * x) +
                        t * z *
                            polynomial(z, {-0x1.55555555554edp-2, 0x1.99999997a04cfp-3, -0x1.2492314fc61adp-3,
                                           0x1.c639a2afa3993p-4})};
}

/// a / b for 0 < a <= b
DoubleDouble ratio(Real a, Real b) {
  const Real q = a / b;
  const DoubleDouble product = exactProduct(q, b);
  return {q, ((a - product.high) - product.low) / b};
}

/// `from` minus x, or plus
Real reflected(const DoubleDouble& from, const DoubleDouble& x, bool minus) {
  return rounded(minus ? from - x : from + x);
}

/// The angle of (x, y) for positive numbers, both finite.
Real firstQuadrant(Real y, Real x, bool left) {
  const bool steep = y > x;
  Real small = steep ? x : y, large = steep ? y : x;
  if (small < large * 0x1p-60) {
    const Real q = small / large;
    return steep ? reflected(kHalfPi, {q}, !left) : left ? rounded({kWholePi.high, kWholePi.low - q}) : q;
  }
  const Real scale = large > 0x1p500 ? 0x1p-600 : large < 0x1p-500 ? 0x1p600 : 1;
  const DoubleDouble angle = arcTangent(ratio(small * scale, large * scale));
  if (steep) return reflected(kHalfPi, angle, !left);
  return left ? reflected(kWholePi, angle, true) : rounded(angle);
}

}  // namespace

Real sin(Real angle) {
  if (!isUsual(angle)) return rareSine(angle, 0);
  const Rest r = restOf(angle);
  return turned(nearZero(r.high, r.low), r.quarters);
}

Real cos(Real angle) {
  if (!isUsual(angle)) return rareSine(angle, 1);
  const Rest r = restOf(angle);
  return turned(nearZero(r.high, r.low), r.quarters + 1);
}

SinCos sincos(Real angle) {
  if (!isUsual(angle)) return {rareSine(angle, 0), rareSine(angle, 1)};
  const Rest r = restOf(angle);
  const LongSinCos rest = nearZero(r.high, r.low);
  return {turned(rest, r.quarters), turned(rest, r.quarters + 1)};
}

Real tan(Real angle) {
  if (std::abs(angle) < 0x1p-27) return angle;
  const Rest r = isUsual(angle) ? restOf(angle) : restOfUnusual(angle);
  const LongSinCos rest = nearZero(r.high, r.low);
  const DoubleDouble sine = quickSum(rest.sin.high, rest.sin.low),
                     cosine = quickSum(rest.cos.high, rest.cos.low);
  return rounded(r.quarters & 1 ? -cosine / sine : sine / cosine);
}

Real asin(Real x) {
  const Real size = std::abs(x);
  if (size < 0x1p-27) return x;
  if (size < 0.5) return x + x * asinRest(x);
  if (!(size <= 1)) return kNan;
  const DoubleDouble half = halfAcos(size), angle = quickSum(kHalfPi.high, -2 * half.high);
  return std::copysign(angle.high + (angle.low + (kHalfPi.low - 2 * half.low)), x);
}

Real acos(Real x) {
  if (std::abs(x) < 0.5) {
    const DoubleDouble angle = quickSum(kHalfPi.high, -x);
    return angle.high + (angle.low + (kHalfPi.low - x * asinRest(x)));
  }
  if (!(std::abs(x) <= 1)) return kNan;
  const DoubleDouble half = halfAcos(std::abs(x));
  if (x > 0) return 2 * rounded(half);
  const DoubleDouble angle = quickSum(kWholePi.high, -2 * half.high);
  return angle.high + (angle.low + (kWholePi.low - 2 * half.low));
}

Real atan(Real x) {
  const Real size = std::abs(x);
  if (!(size >= 0x1p-27)) return x;
  if (size > 0x1p60) return std::copysign(kHalfPi.high, x);
  return std::copysign(
      size <= 1 ? rounded(arcTangent({size})) : rounded(kHalfPi - arcTangent(ratio(1, size))), x);
}

Real atan2(Real y, Real x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const Real right = std::abs(x), up = std::abs(y);
  const bool left = std::signbit(x);
  if (std::isinf(up) && std::isinf(right))
    return std::copysign(left ? 0.75 * kWholePi.high : kHalfPi.high / 2, y);
  if (up == 0 || std::isinf(right)) return std::copysign(left ? kWholePi.high : 0, y);
  if (right == 0 || std::isinf(up)) return std::copysign(kHalfPi.high, y);
  return std::copysign(firstQuadrant(up, right, left), y);
}

}  // namespace trace::math
