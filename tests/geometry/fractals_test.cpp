// Fractals against what is known of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/budget.h"
#include "base/error.h"
#include "geometry/materials.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/fractals/mandelbox.h"
#include "geometry/shapes/fractals/mandelbulb.h"
#include "geometry/shapes/fractals/menger.h"
#include "geometry/shapes/fractals/plant.h"
#include "geometry/shapes/solids/copies.h"
#include "geometry/traced.h"
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
    const TracedShape shape = prepare(Shape(Mandelbulb{.power = power, .iterations = 3, .materials = {}}));
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
  const TracedShape shape = prepare(Shape(Mandelbulb{.power = 5, .iterations = 2, .materials = {}}));
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
  const TracedShape shape =
      prepare(Shape(Mandelbulb{.iterations = 12, .julia = true, .constant = {}, .materials = {}}));
  for (int i = 0; i < 50; ++i) {
    const auto c = crossingsOf(shape, toCentre(random, 3));
    ASSERT_GE(c.size(), 2u);
    EXPECT_NEAR(3 - c[0].t, 1, 1e-5);  // to what the search tells apart
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

/// Where the ball of radius 1 that it is to be is met, how it looks there, and whether it is met again.
/// `detail`: what the search does not tell apart, by which the ball of many repetitions is larger.
void expectABall(const Shape& plain, Random& random, Real detail) {
  const TracedShape shape = prepare(plain);
  for (int i = 0; i < 50; ++i) {
    const Ray ray = toCentre(random, 3);
    const auto c = crossingsOf(shape, ray);
    ASSERT_GE(c.size(), 2u);
    EXPECT_LT(c.back().t - c[0].t, 2 + 2.1 * detail);
    const SurfacePoint s = surfaceOf(shape, ray, c[0]);
    EXPECT_NEAR(length(s.point), 1, detail);
    EXPECT_GT(dot(s.normal, s.point), 0.999999);
    EXPECT_LT(maxComponent(s.error), detail);
    const Ray back = spawnRay(s, s.normal);
    const Real room = length(back.origin - s.point);
    int met = 0;
    for (const Crossing& again : crossingsOf(shape, {back.origin, -s.normal}))
      met += again.t > 0 && again.t <= 2.5 * room;
    EXPECT_GE(met, 1);
  }
}

TEST(Julia, OfAConstantOfZeroIsABallHoweverOftenItIsRepeated) {
  Random random(5);
  for (const Iteration iteration : {Iteration::square, Iteration::cube})
    for (int n = 30; n <= 50; ++n) {
      SCOPED_TRACE(std::string(names(iteration)[static_cast<std::size_t>(iteration)]) + std::to_string(n));
      Julia julia;
      julia.constant = {}, julia.iteration = iteration, julia.iterations = n;
      expectABall(julia, random, 1e-8);
    }
}

TEST(Julia, SaysHowOftenACubeIsFollowed) {
  Julia julia;
  julia.iteration = Iteration::cube, julia.iterations = 36;
  EXPECT_EQ(julia.excess(), "");
  julia.iterations = 40;
  EXPECT_EQ(julia.excess(), "iterations of julia: numbers can follow a cube 36 times, found 40; 36 are used");
  julia.iteration = Iteration::square, julia.iterations = 50;
  EXPECT_EQ(julia.excess(), "");
}

TEST(Fractals, KeepTheirVolumeHoweverOftenTheyAreRepeated) {
  // Some share of the lines along z through a grid, inside the set, measured with few and with many
  // repetitions.
  const auto inside = [](const Shape& shape) {
    const TracedShape traced = prepare(shape);
    Real sum = 0;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j) {
        const auto found = test::crossingsOf(traced, {{0.21 * i + 0.013, 0.21 * j + 0.017, -5}, {0, 0, 1}});
        for (std::size_t k = 0; k + 1 < found.size(); k += 2) sum += found[k + 1].t - found[k].t;
      }
    return sum;
  };
  for (const Iteration iteration : {Iteration::square, Iteration::cube, Iteration::hypercomplex}) {
    Julia julia;
    julia.iteration = iteration;
    julia.constant = {-0.2, 0.3, 0, 0};
    julia.iterations = 8;
    const Real few = inside(julia);
    EXPECT_GT(few, 1);
    for (const int many : {20, 36, 40, 50}) {
      julia.iterations = many;
      EXPECT_GT(inside(julia), 0.9 * few) << names(iteration)[static_cast<std::size_t>(iteration)] << many;
    }
  }
}

TEST(Mandelbulb, OfAConstantOfZeroIsABallHoweverOftenItIsRepeated) {
  Random random(6);
  for (const int power : {2, 8, 16}) {
    SCOPED_TRACE(power);
    expectABall(Mandelbulb{.power = power, .iterations = 30, .julia = true, .constant = {}, .materials = {}},
                random, 4e-4);
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

/// Does the number stay under the repetition? As the definition says, and with other words than the shape's.
bool stays(const Julia& julia, const Vec3& p) {
  using Number = std::array<Real, 4>;
  const auto product = [&](const Number& a, const Number& b) -> Number {
    if (julia.iteration == Iteration::hypercomplex)
      return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] + a[3] * b[3],
              a[0] * b[1] + a[1] * b[0] - a[2] * b[3] - a[3] * b[2],
              a[0] * b[2] + a[2] * b[0] - a[1] * b[3] - a[3] * b[1],
              a[0] * b[3] + a[3] * b[0] + a[1] * b[2] + a[2] * b[1]};
    const Vec3 u{a[1], a[2], a[3]}, v{b[1], b[2], b[3]}, w = v * a[0] + u * b[0] + cross(u, v);
    return {a[0] * b[0] - dot(u, v), w.x, w.y, w.z};
  };
  const Number start{p.x, p.y, p.z, julia.offset};
  Number q = julia.mandelbrot ? Number{} : start, c = julia.constant;
  if (julia.mandelbrot)
    for (std::size_t i = 0; i < 4; ++i) c[i] += start[i];
  for (int i = 0; i < julia.iterations; ++i) {
    const Number square = product(q, q);
    q = julia.iteration == Iteration::cube ? product(square, q) : square;
    Real size = 0;
    for (std::size_t k = 0; k < 4; ++k) q[k] += c[k], size += q[k] * q[k];
    if (size > 16) return false;
  }
  return true;
}

TEST(Julia, AllKernelsFindTheSameBits) {
  Random random(21);
  for (const Iteration iteration : {Iteration::square, Iteration::cube, Iteration::hypercomplex})
    for (const bool mandelbrot : {false, true}) {
      Julia julia;
      julia.iteration = iteration, julia.mandelbrot = mandelbrot, julia.offset = 0.05;
      if (mandelbrot) julia.constant = {0.1, 0, 0.2, 0};
      std::size_t found = 0;
      for (int i = 0; i < 300; ++i) {
        const Vec3 d = random.direction();
        const Ray ray{random.inCube(1) - d * 4, d};
        std::vector<std::vector<Real>> all;
        for (const JuliaKernel& kernel : juliaKernels()) {
          all.emplace_back();
          const auto visit = [&](const Crossing& c) { all.back().push_back(c.t); };
          const Real everywhere = kInfinity;
          TracedJulia(julia, kernel).crossings(ray, Range{-kInfinity, everywhere}, visit);
        }
        for (const auto& of : all) ASSERT_EQ(of, all.front());
        found += all.front().size();
      }
      EXPECT_GT(found, 50u);
    }
}

TEST(Julia, IsInsideWhereTheNumbersStay) {
  Random random(20);
  for (const Iteration iteration : {Iteration::square, Iteration::cube, Iteration::hypercomplex})
    for (const bool mandelbrot : {false, true}) {
      Julia julia;
      julia.iteration = iteration, julia.mandelbrot = mandelbrot, julia.offset = 0.1;
      if (mandelbrot) julia.constant = {0.1, 0, 0.2, 0};
      const TracedShape shape = prepare(Shape(julia));
      int inside = 0, changes = 0;
      constexpr int kRays = kSanitized ? 10 : 100;
      for (int i = 0; i < kRays; ++i) {
        const Vec3 d = random.direction();
        const Ray ray{random.inCube(1) - d * 4, d};
        const auto c = crossingsOf(shape, ray);
        changes += static_cast<int>(c.size());
        for (int k = 0; k < 4000; ++k) {
          const Real t = 8 * random.uniform();
          const auto before =
              std::lower_bound(c.begin(), c.end(), t, [](const Crossing& x, Real at) { return x.t < at; });
          const bool within = (before - c.begin()) % 2 != 0;
          const Real next = before == c.end() ? kInfinity : before->t - t;
          const Real last = before == c.begin() ? kInfinity : t - (before - 1)->t;
          if (std::min(next, last) < 1e-7) continue;
          ASSERT_EQ(stays(julia, ray.at(t)), within)
              << names(iteration)[static_cast<std::size_t>(iteration)] << ' ' << t;
          inside += within;
        }
      }
      EXPECT_GT(inside, 10 * kRays);
      EXPECT_GE(changes, kSanitized ? 2 : kRays);
    }
}

TEST(Fractals, MaterialsFollowTheTrap) {
  Random random(21);
  Julia julia;
  julia.trap = Trap::axis, julia.materials = {{4, 5, 6}};
  const auto traced = julia.prepared();
  const TracedShape shape = prepare(Shape(julia));
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 d = random.direction();
    const Ray ray{random.inCube(0.5) - d * 4, d};
    for (const Crossing& c : crossingsOf(shape, ray)) {
      const MaterialMix of = traced->material(c.part, 9);
      const Real u = Vec2(surfaceOf(shape, ray, c).uv).x;
      EXPECT_NEAR((of.material[0] - 4 + (of.material[1] - of.material[0]) * of.weight[1]) / 2, u, 2e-4);
      ++hits;
    }
  }
  EXPECT_GT(hits, 100);
  std::vector<std::uint32_t> all;
  traced->addMaterials(all);
  EXPECT_EQ(all.size(), 3u);
  EXPECT_EQ(Julia{}.prepared()->material(0, 9).material[0], 9u);
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

TEST(Ifs, MillionsOfCopiesInOnePlaceAreOne) {
  Ifs ifs;
  ifs.maps.clear();
  for (int i = 0; i < 100; ++i) ifs.maps.push_back({0.3, 0, 0, 0.001 * i, 0, 0.3, 0, 0, 0, 0, 0.3, 0});
  ifs.levels = 4;  // a ray along x meets all of its 1e8 cubes
  Budget budget;
  budget.limitTime(60);
  const BudgetScope scope(&budget);
  const auto found = test::crossingsOf(prepare(ifs), {{-5, 0, 0}, {1, 0, 0}});
  ASSERT_EQ(found.size(), 2u);
  const Real last = 0.5 * 0.3 * 0.3 * 0.3 * 0.3;  // half a cube of the last level
  EXPECT_NEAR(found[0].t, 5 - last, 1e-12);
  EXPECT_NEAR(found[1].t, 5 + 0.099 * (1 + 0.3 + 0.09 + 0.027) + last, 1e-12);
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
