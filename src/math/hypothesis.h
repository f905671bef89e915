// Tests of hypotheses, by which pictures that chance made are compared: a p-value is the chance of what was
// found, or of more, if there were no difference. Then all such values are equally likely.
#pragma once

#include <span>
#include <vector>

namespace trace {

/// Values of one kind.
struct Moments {
  double mean = 0, variance = 0;  ///< mean and variance of a value, estimated
  double count = 0;
};
Moments momentsOf(std::span<const double> values);

/// Whether two kinds of values have the same mean, whatever their variances (Welch 1947): both ways off
/// count.
double welch(const Moments& a, const Moments& b);

/// Whether values are spread evenly from 0 to 1 (Kolmogorov 1933, Smirnov 1948; for few of them as in
/// Stephens 1970).
double kolmogorovSmirnov(std::vector<double> values);

/// I_x(a, b), the regularised incomplete beta function: its continued fraction (DLMF 8.17.22).
double incompleteBeta(double a, double b, double x);

}  // namespace trace
