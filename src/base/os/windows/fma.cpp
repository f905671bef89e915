// fma of the C library: that of mingw-w64 rounds twice, and triangles that share an edge rely on one rounding
// (geometry/mesh/triangle.h).
#include <bit>
#include <cmath>
#include <cstdint>

namespace trace::os {
namespace {

struct Sum {
  double high, low;  ///< high + low is exact
};

/// Knuth's.
Sum exactSum(double a, double b) {
  const double sum = a + b, shareOfB = sum - a;
  return {sum, (a - (sum - shareOfB)) + (b - shareOfB)};
}

/// Dekker's, of halves of 26 bits.
Sum exactProduct(double a, double b) {
  const auto split = [](double x) -> Sum {
    const double scaled = 134217729 * x, high = scaled - (scaled - x);
    return {high, x - high};
  };
  const Sum p = split(a), q = split(b);
  const double product = a * b;
  return {product, ((p.high * q.high - product) + p.high * q.low + p.low * q.high) + p.low * q.low};
}

/// a + b; if that is not exact, the neighbour whose last bit is 1, so that rounding again does no harm.
double sumToOdd(double a, double b) {
  const Sum sum = exactSum(a, b);
  const auto bits = std::bit_cast<std::uint64_t>(sum.high);
  if (sum.low == 0 || bits & 1) return sum.high;
  const bool outward = (sum.low > 0) == (sum.high > 0);
  return std::bit_cast<double>(outward ? bits + 1 : bits - 1);
}

/// Boldo and Melquiond, Emulation of FMA and correctly rounded sums, IEEE Transactions on Computers 57(4),
/// 2008.
double emulated(double a, double b, double c) {
  const double plain = a * b + c;
  if (!std::isfinite(plain)) return plain;
  const Sum product = exactProduct(a, b), low = exactSum(c, product.low),
            all = exactSum(product.high, low.high);
  const double result = all.high + sumToOdd(low.low, all.low);
  return std::isfinite(result) ? result : plain;  // a half of a very large factor overflowed
}

__attribute__((target("fma"))) double ofProcessor(double a, double b, double c) {
  return __builtin_fma(a, b, c);
}

}  // namespace
}  // namespace trace::os

extern "C" double fma(double a, double b, double c) {
  static const bool isBuiltIn = __builtin_cpu_supports("fma");
  return isBuiltIn ? trace::os::ofProcessor(a, b, c) : trace::os::emulated(a, b, c);
}
