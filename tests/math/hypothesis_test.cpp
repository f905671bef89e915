// Tests of hypotheses against tables and closed forms.
#include "math/hypothesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/random.h"

namespace trace::test {
namespace {

TEST(Hypothesis, IncompleteBetaHasItsClosedForms) {
  for (const double x : {0.01, 0.2, 0.5, 0.77, 0.999}) {
    EXPECT_NEAR(incompleteBeta(1, 1, x), x, 1e-14);
    EXPECT_NEAR(incompleteBeta(3, 1, x), x * x * x, 1e-14);
    EXPECT_NEAR(incompleteBeta(1, 4, x), 1 - std::pow(1 - x, 4), 1e-13);
    EXPECT_NEAR(incompleteBeta(0.5, 0.5, x), 2 / std::numbers::pi * std::asin(std::sqrt(x)), 1e-13);
  }
}

TEST(Hypothesis, WelchGivesStudentsChances) {
  // Of 10 and 10 values of the same variance there are 18 degrees of freedom: 5 % lie beyond 2.100922.
  const double apart = 2.100922 * std::sqrt(0.2);
  EXPECT_NEAR(welch({0, 1, 10}, {apart, 1, 10}), 0.05, 1e-6);
  EXPECT_NEAR(welch({apart, 1, 10}, {0, 1, 10}), 0.05, 1e-6);
  EXPECT_EQ(welch({1, 0, 5}, {1, 0, 5}), 1);
  EXPECT_EQ(welch({1, 0, 5}, {2, 0, 5}), 0);
}

TEST(Hypothesis, ValuesOfOneKindAreSpreadEvenlyAndOthersAreNot) {
  Random random(3);
  const auto drawn = [&](double shift) {
    std::vector<double> p;
    for (int i = 0; i < 64; ++i) {
      std::vector<double> a, b;
      for (int k = 0; k < 8; ++k) {
        const auto bell = [&] { return random.uniform() + random.uniform() + random.uniform(); };
        a.push_back(bell());
        b.push_back(shift + 3 * bell());
      }
      Moments other = momentsOf(b);
      other.mean -= 3;  // both have the mean 1.5
      p.push_back(welch(momentsOf(a), other));
    }
    return p;
  };
  EXPECT_GT(kolmogorovSmirnov(drawn(0)), 0.01);
  EXPECT_LT(kolmogorovSmirnov(drawn(1)), 1e-4);
  std::vector<double> even;
  for (int i = 0; i < 100; ++i) even.push_back((i + 0.5) / 100);
  EXPECT_GT(kolmogorovSmirnov(even), 0.99);
}

}  // namespace
}  // namespace trace::test
