// Formulas and interval arithmetic.
#include "math/expression.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/random.h"

namespace trace::test {
namespace {

double valueOf(const char* text, const Vec3& p = {2, 3, 5}) { return Expression(text).at(p); }

TEST(Expression, Computes) {
  EXPECT_EQ(valueOf("x + y * z"), 17);
  EXPECT_EQ(valueOf("-x^2"), -4);
  EXPECT_EQ(valueOf("(x - y)^3 / 2"), -0.5);
  EXPECT_EQ(valueOf("2^3"), 8);
  EXPECT_EQ(valueOf("x^-2"), 0.25);
  EXPECT_EQ(valueOf("min(x, y) + max(x, y) - abs(-z)"), 0);
  EXPECT_NEAR(valueOf("sin(pi / 6) + cos(pi / 3)"), 1, 1e-15);
  EXPECT_NEAR(valueOf("log(exp(x)) + sqrt(y * y) + pow(4, 0.5) + tan(pi / 4)"), 8, 1e-14);
  EXPECT_NEAR(valueOf("smoothmin(x, y, 0.01)"), 2, 1e-4);
}

TEST(Expression, RefusesWhatItCannotRead) {
  for (const char* text :
       {"", "x +", "sin x", "foo(3)", "x^y", "((((", "1e999", "x y", "min(x)", "x^65", "2 $ 3"})
    EXPECT_THROW(Expression{text}, Error) << text;
  EXPECT_THROW(Expression(std::string(5000, '(')), Error);
  EXPECT_THROW(Expression(std::string(5000, '-')), Error);
  std::string longText = "x";
  for (int i = 0; i < 1000; ++i) longText += "+x";
  EXPECT_THROW(Expression{longText}, Error);
}

/// Over random stretches of random lines, values and slopes lie within what intervals say.
TEST(Expression, IntervalsHoldEveryValueAndSlope) {
  Random random(1);
  for (const char* text :
       {"x + y - z", "x * y * z - x / (2 + y^2)", "x^3 - y^4 + z^5", "sqrt(x^2 + y^2) - abs(z)",
        "sin(3*x) * cos(5*y) + tan(z / 9)", "exp(x) - log(2 + y^2)", "max(x, min(y, z))", "abs(x)^1.5 + y^-2",
        "smoothmin(x, y, 0.3)"}) {
    const Expression f(text);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 o = random.inCube(3), d = random.inCube(1);
      const double a = random.uniform(-1, 1), b = a + std::pow(10, random.uniform(-9, 0.5));
      const auto over = f.along<Interval>(o, d, Interval{a, b});
      const double t = random.uniform(a, b);
      const auto at = f.along<Real>(o, d, t);
      ASSERT_TRUE(over.value.contains(at.value)) << text;
      ASSERT_TRUE(over.slope.contains(at.slope)) << text;
    }
  }
}

}  // namespace
}  // namespace trace::test
