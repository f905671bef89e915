// A vector at right angles to another.
#include "math/perpendicular.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace trace::test {
namespace {

TEST(PerpendicularTo, IsAUnitVectorAtARightAngleInEveryDirection) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    Vec3 n{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (i < 6) {
      n = {};
      n[i / 2] = i % 2 == 0 ? 1 : -1;
    }
    n = normalize(n);
    const Vec3 p = perpendicularTo(n);
    ASSERT_NEAR(length(p), 1, 1e-15);
    ASSERT_NEAR(dot(p, n), 0, 1e-15);
  }
}

}  // namespace
}  // namespace trace::test
