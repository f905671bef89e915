// Parts that the functions of math/elementary.h share: powers of e and logarithms with more bits than a
// double has.
#pragma once

#include "math/elementary/double_double.h"

namespace trace::math {

using Bits = std::uint64_t;  // those of a double
inline constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
inline constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// e^(x + low) 2^power, where |x| < 800 and |low| is far below 1. Its lower part has a relative error of
/// about 2^-53, and is 0 where the higher part is not normal.
DoubleDouble longExp(Real x, Real low, int power);

/// e^x - 1, where |x| < 700
DoubleDouble longExpm1(Real x);

/// The logarithm of x, or of x + low, where x is positive and finite, and |low| is at most a unit in its last
/// place. Its relative error is about 2^-68.
DoubleDouble longLog(Real x);
DoubleDouble longLog(Real x, Real low);

}  // namespace trace::math
