// The elementary functions with the same bits on every machine. Those of C libraries round differently, and
// some differ even between processors. These use only + - * / and the square root of doubles, which IEEE 754
// defines to the last bit.
//
// The results differ from the exact values by less than one unit in the last place; by less than two for pow,
// the hyperbolic functions, erf and erfc. Special values are those of C (C99, annex F). bench/fit.py fits the
// polynomials. tests/math/elementary_test.cpp measures the errors.
#pragma once

#include "math/vec.h"

namespace trace::math {

struct SinCos {
  Real sin = 0, cos = 1;
};

/// Angles are in radians, and may have any size.
Real sin(Real angle);
Real cos(Real angle);
Real tan(Real angle);
/// Both for little more than one costs.
SinCos sincos(Real angle);

Real asin(Real x);
Real acos(Real x);
Real atan(Real x);
/// The angle of the point (x, y) from the x axis.
Real atan2(Real y, Real x);

Real exp(Real x);
Real exp2(Real x);
/// e^x - 1
Real expm1(Real x);
Real log(Real x);
Real log2(Real x);
Real log10(Real x);
/// log(1 + x)
Real log1p(Real x);
/// x to the power y. Exact wherever x, y and the result are whole numbers below 2^53.
Real pow(Real x, Real y);

Real sinh(Real x);
Real cosh(Real x);
Real tanh(Real x);
Real asinh(Real x);
Real acosh(Real x);
Real atanh(Real x);

Real cbrt(Real x);
/// The length of (x, y), or of (x, y, z), without overflow.
Real hypot(Real x, Real y);
Real hypot(Real x, Real y, Real z);

/// The error function, and 1 minus it.
Real erf(Real x);
Real erfc(Real x);
/// The logarithm of the gamma function of x > 0; its absolute error is below 1e-15 where it is below 1.
Real logGamma(Real x);

}  // namespace trace::math
