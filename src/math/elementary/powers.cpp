// exp, log, pow and their relatives by tables (Tang, Table-driven implementation of the exponential function
// in IEEE floating-point arithmetic, ACM TOMS 15, 1989; of the logarithm, TOMS 16, 1990).
#include <array>
#include <cstddef>

#include "math/elementary.h"
#include "math/elementary/parts.h"

namespace trace::math {
namespace {

constexpr int kSteps = 128;  // between powers of two
constexpr Bits kInfinite = 0x7ff0000000000000u, kLeastNormal = 0x0010000000000000u;
/// Added to a small number and subtracted again, it rounds to whole numbers; the sum holds them in its lower
/// bits.
constexpr Real kRounds = 0x1.8p52;

/// 2^(j/128) as high (1 + low).
constexpr auto powersOfTwo() {
  DoubleDouble step{1}, term{1};
  for (int k = 1; k <= 16; ++k) {
    term = term * kLn2 / DoubleDouble{Real(kSteps * k)};
    step = step + term;
  }
  std::array<DoubleDouble, kSteps> table{};
  DoubleDouble power{1};
  for (DoubleDouble& entry : table) {
    entry = {power.high, power.low / power.high};
    power = power * step;
  }
  return table;
}
constexpr std::array<DoubleDouble, kSteps> kPowersOfTwo = powersOfTwo();

/// The part of log(x) that x's upper bits determine.
struct LogStep {
  Real inverse = 1;        ///< one over the middle c of these numbers, in 8 bits
  Real high = 0, low = 0;  ///< the logarithm of 1 / inverse; `high` is a multiple of 2^-42
};
constexpr Bits kFirstStep = 0x3fe6800000000000u;  // 0.703125: logarithms of numbers near 1 come from one step

constexpr auto logSteps() {
  std::array<LogStep, kSteps> table{};
  for (int j = 0; j < kSteps; ++j) {
    const auto middle = bitCast<Real>(kFirstStep + (static_cast<Bits>(j) << 45));
    const Real steps = middle < 1 ? 128 : 256;  // x / c - 1 is a double
    const Real inverse = static_cast<Real>(static_cast<int>(steps / middle + 0.5)) / steps;
    const DoubleDouble z = DoubleDouble{1 - inverse} / DoubleDouble{1 + inverse}, square = z * z;
    DoubleDouble power = z, sum{0};  // log(1 / inverse) = 2 (z + z^3/3 + z^5/5 + ...)
    for (int k = 1; k < 48 && power.high != 0; k += 2) {
      sum = sum + power / DoubleDouble{Real(k)};
      power = power * square;
    }
    const Real high = (2 * sum.high + 0x1.8p10) - 0x1.8p10;
    table[static_cast<std::size_t>(j)] = {inverse, high, (2 * sum.high - high) + 2 * sum.low};
  }
  return table;
}
constexpr std::array<LogStep, kSteps> kLogSteps = logSteps();

// ln 2 and ln 2 / 128 in two parts, the upper ones short: products with whole numbers that occur are exact.
constexpr Real kLn2High = 0x1.62e42fefa3800p-1, kLn2Low = 0x1.ef35793c76730p-45;
constexpr Real kStepHigh = 0x1.62e42fef80000p-8, kStepLow = 0x1.1cf79abc9e3b4p-43;

/// 2^k without the range of doubles: in two factors.
Real scaled(Real x, int k) {
  const auto powerOf2 = [](int n) { return bitCast<Real>(static_cast<Bits>(1023 + n) << 52); };
  return x * powerOf2(k / 2) * powerOf2(k - k / 2);
}

/// (e^r - 1 - r) / r^2 for |r| up to ln 2 / 256; the first with an error relative to e^r, the second to e^r -
/// 1
inline Real expRest(Real r) {
  return (0x1.ffffffffffda5p-2 + r * 0x1.555555555542fp-3) +
         r * r * (0x1.55555d18f5348p-5 + r * 0x1.11111698f3193p-7);
}
inline Real expm1Rest(Real r) {
  return (0x1.0000000000000p-1 + r * 0x1.55555555554a9p-3) +
         r * r * ((0x1.5555555555691p-5 + r * 0x1.11111580f491ap-7) + r * r * 0x1.6c16c08b31158p-10);
}

/// 2^(n/128) e^r = 2^power high (1 + rest), where r is small
struct Power {
  Real high, rest;
  int power;
};
inline Power powerOf(Bits n, Real r) {
  const DoubleDouble& step = kPowersOfTwo[static_cast<std::size_t>(n & (kSteps - 1))];
  return {step.high, r + (step.low + r * r * expRest(r)), static_cast<std::int32_t>(n) >> 7};
}

/// e^(x + low)
inline Power expOf(Real x, Real low) {
  const Real shifted = x * (kSteps * 0x1.71547652b82fep+0) + kRounds, n = shifted - kRounds;
  return powerOf(bitCast<Bits>(shifted), ((x - n * kStepHigh) - n * kStepLow) + low);
}

/// The value, where it is a normal number.
inline DoubleDouble normalValue(const Power& p) {
  const auto scale =
      bitCast<Real>(bitCast<Bits>(p.high) + (static_cast<Bits>(static_cast<std::int64_t>(p.power)) << 52));
  return {scale, scale * p.rest};
}
inline Real anyValue(const Power& p) { return scaled(p.high + p.high * p.rest, p.power); }

/// A number for the logarithm: x = 2^k c (1 + first + second), where c (1 + first) has the upper half of its
/// bits.
struct LogParts {
  const LogStep& step;
  Real k, first, second;
};
inline LogParts logParts(Bits bits) {
  const Bits offset = bits + (Bits{1} << 44) - kFirstStep;  // the nearest c counts
  const auto k = static_cast<std::int64_t>(offset) >> 52;
  const LogStep& step = kLogSteps[static_cast<std::size_t>(offset >> 45 & (kSteps - 1))];
  const auto m = bitCast<Real>(bits - (static_cast<Bits>(k) << 52));
  const auto high = bitCast<Real>((bitCast<Bits>(m) + 0x80000000u) & ~Bits{0xffffffffu});
  return {step, static_cast<Real>(k), high * step.inverse - 1, (m - high) * step.inverse};  // both are exact
}

/// The bits of a positive number, as if the least numbers had all their 53 bits.
inline Bits normalBits(Real x) {
  const auto bits = bitCast<Bits>(x);
  return bits >= kLeastNormal ? bits : bitCast<Bits>(x * 0x1p52) - (Bits{52} << 52);
}

/// The logarithm. Its low part may be larger than half a unit in the last place of the high part.
inline DoubleDouble logOf(Bits bits) {
  const LogParts x = logParts(bits);
  const Real r = x.first + x.second, square = x.first * x.first;  // exact, both
  const Real squareLow = x.second * (x.first + r), r2 = square + squareLow;
  const DoubleDouble whole = quickSum(x.k * kLn2High + x.step.high, r),
                     sum = quickSum(whole.high, -0.5 * square);
  const Real rest = (0x1.5555555555564p-2 + r * -0x1.0000000000014p-2) +
                    r2 * ((0x1.999999949f6edp-3 + r * -0x1.5555554fc0d65p-3) +
                          r2 * (0x1.24961d65f27b7p-3 + r * -0x1.0003c4aa2df43p-3));
  const Real low = (x.k * kLn2Low + x.step.low) + (whole.low + sum.low) - 0.5 * squareLow;
  return {sum.high, low + r2 * r * rest};
}

bool isWhole(Real y) { return std::floor(y) == y; }
bool isOdd(Real y) { return isWhole(y) && std::abs(y) < 0x1p53 && std::fmod(y, 2) != 0; }

/// e^x where that is not a normal number, or nearly not.
Real rareExp(Real x, Real low) {
  if (!(std::abs(x) < 746)) return x > 0 ? kInfinity : x < 0 ? 0 : x;
  return anyValue(expOf(x, low));
}
inline Real quickExp(Real x, Real low) {
  if (!(std::abs(x) < 708)) return rareExp(x, low);
  return rounded(normalValue(expOf(x, low)));
}

/// For positive x, and y that is neither tiny nor huge. The upper halves of the logarithm and of y have an
/// exact product.
inline Real quickPow(Bits bits, Real y) {
  const DoubleDouble log = logOf(bits);
  const Real logHigh = upperHalf(log.high), yHigh = upperHalf(y), logLow = (log.high - logHigh) + log.low;
  return quickExp(yHigh * logHigh, (y - yHigh) * logHigh + y * logLow);
}

/// For numbers that are not positive, normal and finite, or y that is tiny or huge.
Real specialPow(Real x, Real y) {
  if (x == 1 || y == 0) return 1;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const Real size = std::abs(x);
  if (std::isinf(y)) return size == 1 ? 1 : (size > 1) == (y > 0) ? kInfinity : 0;
  const Real sign = std::signbit(x) && isOdd(y) ? -1 : 1;
  if (size == 0 || std::isinf(x)) return sign * ((size == 0) == (y > 0) ? 0 : kInfinity);
  if (x < 0 && !isWhole(y)) return kNan;
  if (size == 1 || std::abs(y) <= 0x1p-70) return sign;
  if (std::abs(y) >= 0x1p70) return (size > 1) == (y > 0) ? kInfinity : 0;
  return sign * quickPow(normalBits(size), y);
}

}  // namespace

DoubleDouble longExp(Real x, Real low, int power) {
  Power p = expOf(x, low);
  p.power += power;
  return -1022 < p.power && p.power < 1023 ? normalValue(p) : DoubleDouble{anyValue(p)};
}

DoubleDouble longExpm1(Real x) {
  const Real shifted = x * (kSteps * 0x1.71547652b82fep+0) + kRounds, n = shifted - kRounds;
  const auto whole = static_cast<std::int32_t>(bitCast<Bits>(shifted));
  const Real upper = x - n * kStepHigh, lower = n * kStepLow, r = upper - lower, rLow = (upper - r) - lower;
  const DoubleDouble& step = kPowersOfTwo[static_cast<std::size_t>(whole & (kSteps - 1))];
  const Real power = scaled(step.high, whole >> 7),
             rest = rLow + r * r * expm1Rest(r);  // e^x = power (1 + r + rest)
  const DoubleDouble without = exactSum(power, -1), product = exactProduct(power, r);
  const DoubleDouble sum = exactSum(without.high, product.high);
  return quickSum(sum.high, sum.low + without.low + product.low + power * (rest + step.low * (1 + r)));
}

DoubleDouble longLog(Real x) {
  const DoubleDouble log = logOf(normalBits(x));
  return quickSum(log.high, log.low);
}
DoubleDouble longLog(Real x, Real low) {
  const DoubleDouble log = logOf(normalBits(x));
  return quickSum(log.high, log.low + low / x);
}

Real exp(Real x) { return quickExp(x, 0); }

Real exp2(Real x) {
  if (!(std::abs(x) < 1080)) return x > 0 ? kInfinity : x < 0 ? 0 : x;
  const Real shifted = x + kRounds / kSteps, n = shifted - kRounds / kSteps;
  const Power power = powerOf(bitCast<Bits>(shifted), (x - n) * kLn2.high);
  return x > -1021 && x < 1023 ? rounded(normalValue(power)) : anyValue(power);
}

Real expm1(Real x) {
  if (!(std::abs(x) < 746)) return x > 0 ? kInfinity : x < 0 ? -1 : x;
  if (std::abs(x) < 0x1p-54) return x;
  if (x > 40) return exp(x);  // 1 is far below its last place
  return rounded(longExpm1(x));
}

Real log(Real x) {
  auto bits = bitCast<Bits>(x);
  if (bits - kLeastNormal >= kInfinite - kLeastNormal) {
    if (x == 0) return -kInfinity;
    if (!(x > 0)) return x < 0 ? kNan : x;
    if (bits == kInfinite) return x;
    bits = normalBits(x);
  }
  const LogParts at = logParts(bits);
  const Real r = at.first + at.second, square = r * r;
  const DoubleDouble sum = quickSum(at.k * kLn2High + at.step.high, r);
  const Real rest = (-0x1.0000000000005p-1 + r * 0x1.5555555555565p-2) +
                    square * ((-0x1.fffffffb99789p-3 + r * 0x1.99999994736fap-3) +
                              square * (-0x1.5559421171f2ap-3 + r * 0x1.249629d6ec86dp-3));
  return sum.high + (sum.low + (at.k * kLn2Low + at.step.low) + square * rest);
}

Real log2(Real x) {
  if (!(x > 0) || x == kInfinity) return log(x);
  return (longLog(x) * DoubleDouble{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56}).high;
}

Real log10(Real x) {
  if (!(x > 0) || x == kInfinity) return log(x);
  return (longLog(x) * DoubleDouble{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57}).high;
}

Real log1p(Real x) {
  if (!(x > -1) || x == kInfinity) return x == -1 ? -kInfinity : x < -1 ? kNan : x;
  if (std::abs(x) < 0x1p-54) return x;
  const DoubleDouble sum = exactSum(1, x);
  return longLog(sum.high, sum.low).high;
}

Real pow(Real x, Real y) {
  const auto bits = bitCast<Bits>(x);
  const Real size = std::abs(y);
  if (bits - kLeastNormal >= kInfinite - kLeastNormal || !(size > 0x1p-70 && size < 0x1p70))
    return specialPow(x, y);
  return quickPow(bits, y);
}

}  // namespace trace::math
