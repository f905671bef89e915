// Fractals against what is known of them.
#include <gtest/gtest.h>

#include "base/error.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

Ray toCentre(Random& random, Real from) {
  const Vec3 d = random.direction();
  return {d * from, -d};
}

TEST(Mandelbulb, LiesWithinItsRadius) {
  Random random(1);
  for (const int power : {2, 3, 8}) {
    const Real most = std::pow(2.0, 1.0 / (power - 1));
    const TracedShape shape = prepare(Shape(Mandelbulb{.power = power, .iterations = 3}));
    for (int i = 0; i < 200; ++i) {
      const auto c = crossingsOf(shape, toCentre(random, 4));
      ASSERT_GE(c.size(), 2u);
      EXPECT_LE(4 - c[0].t, most * (1 + 1e-12));
      EXPECT_LT(c[0].t, 4);  // the origin stays
      EXPECT_GT(c.back().t, 4);
    }
  }
  EXPECT_NEAR(boundsOf(prepare(Shape(Mandelbulb{}))).high.x, 1.10409, 1e-5);
}

TEST(Mandelbulb, IsTurnedOntoItselfByItsPower) {
  // Around z by 1 / (power - 1) of a turn.
  Random random(2);
  const TracedShape shape = prepare(Shape(Mandelbulb{.power = 5, .iterations = 2}));
  const Affine turn = Affine::rotation({0, 0, 1}, 2 * kPi / 4);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 target = random.inCube(1), d = random.direction();
    const Ray ray{target - d * 3, d}, turned{turn * ray.origin, linear(turn, d)};
    const auto a = crossingsOf(shape, ray), b = crossingsOf(shape, turned);
    if (a.empty()) continue;
    ASSERT_FALSE(b.empty());
    EXPECT_NEAR(a[0].t, b[0].t, 1e-4);
    ++hits;
  }
  EXPECT_GT(hits, 20);
}

TEST(Mandelbulb, OfAConstantOfZeroIsABall) {
  Random random(3);
  const TracedShape shape = prepare(Shape(Mandelbulb{.iterations = 12, .julia = true, .constant = {}}));
  for (int i = 0; i < 50; ++i) {
    const auto c = crossingsOf(shape, toCentre(random, 3));
    ASSERT_EQ(c.size(), 2u);
    EXPECT_NEAR(3 - c[0].t, 1, 1e-8);
  }
}

TEST(Mandelbox, HasTheSymmetryOfACube) {
  Random random(4);
  const TracedShape shape = prepare(Shape(Mandelbox{}));
  for (int i = 0; i < 100; ++i) {
    const Vec3 target = random.inCube(0.8), d = random.direction(), o = target - d * 3;
    const auto a = crossingsOf(shape, {o, d});
    const auto b = crossingsOf(shape, {{-o.y, o.z, o.x}, {-d.y, d.z, d.x}});
    ASSERT_EQ(a.empty(), b.empty());
    if (!a.empty()) {
      EXPECT_NEAR(a[0].t, b[0].t, 1e-4);
    }
  }
}

TEST(Julia, FunctionsAreThoseOfComplexNumbers) {
  // In the plane of 1 and i quaternions are complex numbers. One step of the exponential: Re(exp(q)) < 4.
  Julia julia;
  julia.iteration = Iteration::exponential, julia.constant = {}, julia.iterations = 1;
  const auto c = crossingsOf(julia, {{-3, 0.5, 0}, {1, 0, 0}});
  ASSERT_EQ(c.size(), 2u);
  EXPECT_NEAR(c[1].t - 3, std::log(4 / std::cos(0.5)), 1e-12);
  // One step of the sine: |Im(sin(q))| = |cos(a) sinh(b)| < 4; along the axis i, sinh(b) = 4.
  julia.iteration = Iteration::sine;
  const auto s = crossingsOf(julia, {{0, 3, 0}, {0, -1, 0}});
  ASSERT_EQ(s.size(), 2u);
  EXPECT_NEAR(3 - s[0].t, std::asinh(4), 1e-12);
}

TEST(Fractals, TrapsColourFromZeroToOne) {
  Random random(5);
  for (const Trap trap : {Trap::point, Trap::axis, Trap::plane}) {
    Julia julia;
    julia.trap = trap, julia.iterations = 5;
    Mandelbulb bulb;
    bulb.trap = trap;
    for (const TracedShape& shape : {prepare(Shape(julia)), prepare(Shape(bulb))}) {
      Real least = 1, most = 0;
      for (int i = 0; i < 200; ++i) {
        const Ray ray = toCentre(random, 3);
        for (const Crossing& c : crossingsOf(shape, ray)) {
          const Vec2 uv = surfaceOf(shape, ray, c).uv;
          least = min(least, uv.x), most = max(most, uv.x);
          EXPECT_TRUE(uv.y >= 0 && uv.y <= 1);
        }
      }
      EXPECT_GE(least, 0);
      EXPECT_LE(most, 1);
      EXPECT_GT(most, least + 0.05);
    }
  }
}

TEST(Ifs, OfTwentyCubesIsTheMengerSponge) {
  Ifs ifs;
  ifs.levels = 2, ifs.maps.clear();
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if ((x == 0) + (y == 0) + (z == 0) < 2) {
          const Real third = 1.0 / 3;
          ifs.maps.push_back({third, 0, 0, x * third, 0, third, 0, y * third, 0, 0, third, z * third});
        }
  const TracedShape copies = prepare(Shape(ifs));
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 target = random.inCube(0.5), d = random.direction();
    const Ray ray{target - d * 3, d};
    const auto length = [&](const TracedShape& shape) {
      Real inside = 0;
      const auto c = crossingsOf(shape, ray);
      for (size_t k = 0; k + 1 < c.size(); k += 2) inside += c[k + 1].t - c[k].t;
      return inside;
    };
    EXPECT_NEAR(length(copies), length(prepare(Shape(Menger{2}))), 1e-12);
  }
}

TEST(Ifs, RefusesMapsThatDoNotShrink) {
  Ifs ifs;
  ifs.maps = {{1, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0}};
  EXPECT_THROW(ifs.prepared(), Error);
  ifs.maps = {{0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0, 0}};
  EXPECT_THROW(ifs.prepared(), Error);
  ifs.maps = {{0.6, -0.6, 0, 0, 0.6, 0.6, 0, 0, 0, 0, 0.9, 0}};  // turned, and shrunk to 0.85
  EXPECT_NO_THROW(ifs.prepared());
}

TEST(Plant, GrowsAsItsRulesSay) {
  Plant plant;
  plant.axiom = "F", plant.rules = {"F = F[+F]F"}, plant.iterations = 1, plant.jitter = 0, plant.taper = 1;
  plant.angle = 90, plant.radius = 0.01, plant.height = 2;
  const TracedShape shape =
      prepare(Shape(plant));  // a stem of two steps, and one to the left from its middle
  const Box3 box = boundsOf(shape);
  EXPECT_NEAR(box.high.z, 2.01, 1e-12);
  EXPECT_NEAR(box.low.x, -1.007, 1e-12);
  EXPECT_EQ(crossingsOf(shape, {{-3, 0, 0.5}, {1, 0, 0}}).size(), 2u);
  EXPECT_EQ(crossingsOf(shape, {{-0.5, -3, 1}, {0, 1, 0}}).size(), 2u);
  EXPECT_EQ(crossingsOf(shape, {{-0.5, -3, 0.9}, {0, 1, 0}}).size(), 0u);
}

TEST(Plant, EndsWhereItWouldGrowWithoutEnd) {
  Plant plant;
  plant.iterations = 20, plant.rules = {"X = XXX"};
  EXPECT_THROW(plant.prepared(), Error);
  plant.rules = {"X = F"}, plant.iterations = 1;
  EXPECT_NO_THROW(plant.prepared());
  plant.rules = {"nonsense"};
  EXPECT_THROW(plant.prepared(), Error);
}

TEST(Plant, IsAnotherForAnotherSeed) {
  Plant plant;
  const Box3 a = boundsOf(prepare(Shape(plant)));
  EXPECT_EQ(boundsOf(prepare(Shape(plant))), a);
  plant.seed = 2;
  EXPECT_NE(boundsOf(prepare(Shape(plant))), a);
}

}  // namespace
}  // namespace trace::test
