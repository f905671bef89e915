#include "math/hypothesis.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace trace {

Moments momentsOf(std::span<const double> values) {
  Moments m;
  m.count = static_cast<double>(values.size());
  for (const double x : values) m.mean += x / m.count;
  for (const double x : values) m.variance += (x - m.mean) * (x - m.mean) / (m.count - 1);
  return m;
}

double incompleteBeta(double a, double b, double x) {
  if (!(x > 0)) return 0;
  if (!(x < 1)) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incompleteBeta(b, a, 1 - x);
  const double front = math::exp(math::logGamma(a + b) - math::logGamma(a) - math::logGamma(b) +
                                 a * math::log(x) + b * math::log1p(-x)) /
                       a;
  // Lentz's way: numerators and denominators of the fraction, one after the other.
  constexpr double kTiny = 1e-300, kClose = 1e-15;
  constexpr int kMost = 1000;
  const auto safe = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1, d = 1 / safe(1 - (a + b) * x / (a + 1)), fraction = d;
  for (int m = 1; m < kMost; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / safe(1 + even * d);
    c = safe(1 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / safe(1 + odd * d);
    c = safe(1 + odd / c);
    fraction *= d * c;
    if (std::abs(d * c - 1) < kClose) break;
  }
  return front * fraction;
}

double welch(const Moments& a, const Moments& b) {
  const double u = a.variance / a.count, v = b.variance / b.count;
  if (!(u + v > 0)) return a.mean == b.mean ? 1 : 0;
  const double t2 = (a.mean - b.mean) * (a.mean - b.mean) / (u + v);
  const double freedom = (u + v) * (u + v) / (u * u / (a.count - 1) + v * v / (b.count - 1));
  return incompleteBeta(freedom / 2, 0.5, freedom / (freedom + t2));
}

double kolmogorovSmirnov(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto before = static_cast<double>(i);
    most = std::max({most, values[i] - before / n, (before + 1) / n - values[i]});
  }
  const double root = std::sqrt(n), z = (root + 0.12 + 0.11 / root) * most;
  constexpr double kSmall = 0.2;  // below it the chance is 1 to all digits, and the sum is slow
  if (z < kSmall) return 1;
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 ? 2 : -2) * math::exp(-2 * k * k * z * z);
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace trace
