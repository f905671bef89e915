// Balls of haze: what a ray passes through, against the integral of the density.
#include "geometry/shapes/surfaces/puff.h"

#include <gtest/gtest.h>

#include "geometry/materials.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

/// How much of the light the haze stops on the ray's way from `from` to `to`: 3/4 depth (1 - r^2) a length.
Real stopped(const Puff& puff, const Ray& ray, Real from, Real to) {
  constexpr int kSteps = 20000;
  Real sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 p = ray.at(from + (to - from) * (i + 0.5) / kSteps);
    sum += max(1 - dot(p, p), 0);
  }
  return 1 - std::exp(-0.75 * puff.depth * sum * (to - from) / kSteps * length(ray.direction));
}

TEST(Puff, StopsWhatItsDensityStops) {
  Random random(1);
  Puff puff;
  puff.depth = 1.7, puff.materials = {{3, 8}};
  const TracedShape shape = prepare(Shape(puff));
  for (int i = 0; i < 200; ++i) {
    const Vec3 d = random.direction() * random.uniform(0.5, 3);
    const bool within = i % 2 != 0;
    const Ray ray{within ? random.inCube(0.5) : random.inCube(0.6) - d * 10, d};
    const auto c = crossingsOf(shape, ray);
    if (c.empty()) continue;
    ASSERT_EQ(c.size(), 2u);
    const auto of = [&](const Crossing& at) { return puff.material(at.part, 0); };
    if (within) {  // it begins inside: what is left of the way lies before where it leaves
      EXPECT_NEAR(of(c[1]).weight[1], stopped(puff, ray, 0, c[1].t), 1e-4);
    } else {
      EXPECT_NEAR(of(c[0]).weight[1], stopped(puff, ray, c[0].t, c[1].t), 1e-4);
      EXPECT_EQ(of(c[1]).weight[1], 0) << "leaving takes nothing away once more";
    }
    EXPECT_EQ(of(c[0]).material[0], 3u);
    EXPECT_EQ(of(c[0]).material[1], 8u);
  }
  EXPECT_EQ(Puff{}.material(0, 5).material[0], MaterialMix::kClear);
  EXPECT_EQ(Puff{}.material(0, 5).material[1], 5u);
}

}  // namespace
}  // namespace trace::test
