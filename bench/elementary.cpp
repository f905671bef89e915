// The time of the functions of math/elementary.h, compared with those of the C library, at arguments that
// rays often have.
#include "math/elementary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "math/noise.h"
#include "stopwatch.h"

namespace trace::bench {
namespace {

struct Case {
  const char* name;
  Real low, high;
  Real (*ours)(Real);
  Real (*theirs)(Real);
};

/// Nanoseconds of a call: one after another if each needs the last result, else overlapping.
Real nanoseconds(Real (*f)(Real), const std::vector<Real>& arguments, bool needsLast) {
  Real least = kInfinity;
  [[maybe_unused]] volatile Real result = 0;
  for (int pass = 0; pass < 20; ++pass) {
    const Real start = threadSeconds();
    Real sum = 0;
    for (const Real x : arguments) sum = needsLast ? f(x + sum * 0x1p-60) : sum + f(x);
    result = sum;
    least = std::min(least, threadSeconds() - start);
  }
  return 1e9 * least / static_cast<Real>(arguments.size());
}

void print(const Case& c) {
  std::vector<Real> arguments;
  for (std::uint64_t i = 0; i < 20000; ++i)
    arguments.push_back(c.low + (c.high - c.low) * unitFromBits(mixBits(i)));
  std::printf("%-12s", c.name);
  for (const bool needsLast : {false, true})
    std::printf("  %6.1f %6.1f", nanoseconds(c.ours, arguments, needsLast),
                nanoseconds(c.theirs, arguments, needsLast));
  std::printf("\n");
}

}  // namespace
}  // namespace trace::bench

int main() {
  using trace::Real;
  namespace math = trace::math;
  std::printf("nanoseconds    overlapping       one by one\n                ours   libm     ours   libm\n");
  const trace::bench::Case cases[] = {
      {"sin", 0, 6.2832, math::sin, std::sin},
      {"cos", 0, 6.2832, math::cos, std::cos},
      {"sin and cos", 0, 6.2832,
       [](Real x) {
         const math::SinCos both = math::sincos(x);
         return both.sin + both.cos;
       },
       [](Real x) { return std::sin(x) + std::cos(x); }},
      {"tan", -1.5, 1.5, math::tan, std::tan},
      {"asin", -1, 1, math::asin, std::asin},
      {"acos", -1, 1, math::acos, std::acos},
      {"atan", -3, 3, math::atan, std::atan},
      {"atan2", -1, 1, [](Real y) { return math::atan2(y, 0.3); }, [](Real y) { return std::atan2(y, 0.3); }},
      {"exp", -5, 0, math::exp, std::exp},
      {"expm1", -3, 0, math::expm1, std::expm1},
      {"log", 0, 1, math::log, std::log},
      {"log1p", -0.9, 0, math::log1p, std::log1p},
      {"log2", 0, 10, math::log2, std::log2},
      {"pow 2.4", 0, 1, [](Real x) { return math::pow(x, 2.4); }, [](Real x) { return std::pow(x, 2.4); }},
      {"pow 50", 0, 1, [](Real x) { return math::pow(x, 50); }, [](Real x) { return std::pow(x, 50); }},
      {"cbrt", 0, 10, math::cbrt, std::cbrt},
      {"hypot", -1, 1, [](Real y) { return math::hypot(y, 0.3); }, [](Real y) { return std::hypot(y, 0.3); }},
      {"erf", -2, 2, math::erf, std::erf},
  };
  for (const trace::bench::Case& c : cases) trace::bench::print(c);
}
