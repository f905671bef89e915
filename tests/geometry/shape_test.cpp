// What must hold for every shape on the list.
#include <gtest/gtest.h>

#include "base/error.h"
#include "geometry/shapes/fractals/julia.h"
#include "geometry/shapes/fractals/menger.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/copies.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/shapes/solids/superellipsoid.h"
#include "geometry/shapes/solids/supertoroid.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "geometry/shapes/surfaces/lathe.h"
#include "geometry/shapes/surfaces/metaballs.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

// For each sample of each shape, of which there are about ten.
const int kRays = kSanitized ? 500 : thorough() ? 100000 : 5000;

/// A ray that passes near the shape, from well outside.
Ray rayToward(const Box3& box, Random& random) {
  const Vec3 target = box.center() + random.inCube(0.55 * maxComponent(box.size()));
  const Vec3 d = random.direction();
  return {target - d * (3 * length(box.size())), d};
}

TEST(Shapes, AreCheckedAsTheyArePrepared) {
  for (const Shape& plain : analyticShapes()) {
    SCOPED_TRACE(nameOf(plain));
    const TracedShape shape = prepare(plain);
    const ShapeFacts facts = check(plain);
    const Box3 box = shape.bounds();
    EXPECT_EQ(facts.solid, shape.solid());
    EXPECT_EQ(facts.partCount, shape.partCount());
    EXPECT_TRUE(box.empty() || facts.bounds.unbounded() ||
                (facts.bounds.contains(box.low) && facts.bounds.contains(box.high)));
  }
}

/// What the call says is wrong.
template <class Call>
std::string errorOf(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.messages().front().what;
  }
  return "nothing";
}

TEST(Shapes, ThatCannotBeTracedAreFoundByBoth) {
  const Operand ball{"", Sphere{}, {}, 0}, flat{"", Sphere{}, Affine::scaling({1, 1, 0}), 0},
      open{"", Square{}, {}, 0};
  const auto both = [](const Shape& shape) {
    const std::string error = errorOf([&] { prepare(shape); });
    EXPECT_EQ(errorOf([&] { check(shape); }), error);
    return error;
  };
  const auto solids = [](std::vector<Operand> all) { return Operands(std::move(all)); };
  EXPECT_EQ(both(Union{solids({ball, flat})}), "an object of a solid is squeezed flat by its transform");
  EXPECT_EQ(both(Difference{solids({open, ball})}), "an object of a solid is open: it encloses nothing");
  EXPECT_EQ(both(Clip{solids({open, ball})}), "nothing");
  EXPECT_EQ(both(Clip{solids({ball, open})}), "an object of a solid is open: it encloses nothing");
  EXPECT_EQ(both(Ifs{.maps = {}}), "maps: expected at least one");
  Shape nested = Sphere{};
  for (int i = 0; i < 70; ++i) nested = Union{solids({{"", nested, {}, 0}, ball})};
  EXPECT_EQ(both(nested), "solids are nested too deeply in unions, intersections or differences");
}

TEST(Shapes, HitsLieInBoundsOnTheRayWithUnitNormals) {
  Random random(1);
  for (const Shape& plain : analyticShapes()) {
    SCOPED_TRACE(nameOf(plain));
    const TracedShape shape = prepare(plain);
    const Box3 box = boundsOf(shape);
    const Box3 close = closeBoundsOf(shape);
    const double size = length(close.size());
    int hits = 0;
    const int rays = raysFor(plain, kRays);
    for (int i = 0; i < rays; ++i) {
      const Ray ray = rayToward(close, random);
      for (const Crossing& c : placesOf(shape, ray)) {
        const SurfacePoint s = surfaceOf(shape, ray, c);
        ++hits;
        EXPECT_TRUE((Box3{box.low - s.error, box.high + s.error}.contains(s.point)));
        const double far = std::max(3 * size, length(ray.at(c.t)));  // seen from three sizes away
        EXPECT_LT(length(s.point - ray.at(c.t)), 1e-13 * far);
        EXPECT_NEAR(length(s.normal), 1, 1e-14);
        EXPECT_EQ(s.normal, s.shading);
        const Vec2 uv = s.uv;
        EXPECT_TRUE(uv.x >= -1e-12 && uv.x <= 1 + 1e-12 && uv.y >= -1e-12 && uv.y <= 1 + 1e-12);
      }
    }
    EXPECT_GT(hits, rays / 50);
  }
}

TEST(Shapes, SolidsAreEnteredAndLeftInTurn) {
  Random random(2);
  for (const Shape& plain : analyticShapes()) {
    const TracedShape shape = prepare(plain);
    if (!isSolid(shape)) continue;
    SCOPED_TRACE(nameOf(plain));
    for (int i = 0; i < raysFor(plain, kRays); ++i) {
      const Ray ray = rayToward(closeBoundsOf(shape), random);
      const auto crossings = crossingsOf(shape, ray);
      ASSERT_EQ(crossings.size() % 2, 0u);
      for (size_t k = 0; k < crossings.size(); ++k) {
        if (!std::isfinite(crossings[k].t)) continue;
        const Real along = dot(surfaceOf(shape, ray, crossings[k]).normal, ray.direction);
        if (std::abs(along) < 1e-6) continue;  // grazing: either is right
        EXPECT_EQ(along < 0, k % 2 == 0);
      }
    }
  }
}

TEST(Shapes, OpenSheetsTurnTheirNormalToTheRay) {
  Random random(3);
  for (const Shape& plain : analyticShapes()) {
    const TracedShape shape = prepare(plain);
    if (isSolid(shape)) continue;
    SCOPED_TRACE(nameOf(plain));
    for (int i = 0; i < raysFor(plain, kRays); ++i) {
      const Ray ray = rayToward(closeBoundsOf(shape), random);
      for (const Crossing& c : crossingsOf(shape, ray))
        EXPECT_LE(dot(surfaceOf(shape, ray, c).normal, ray.direction), 0);
    }
  }
}

TEST(Shapes, NormalsStandOnTheSurface) {
  // Two neighbouring hits on the same part differ, to first order, along the tangent plane.
  Random random(4);
  for (const Shape& plain : analyticShapes()) {
    SCOPED_TRACE(nameOf(plain));
    const TracedShape shape = prepare(plain);
    for (int i = 0; i < raysFor(plain, kRays); ++i) {
      const Ray ray = rayToward(closeBoundsOf(shape), random);
      const Ray close{ray.origin + random.direction() * 1e-6, ray.direction};
      const auto a = placesOf(shape, ray), b = placesOf(shape, close);
      if (a.empty() || b.size() != a.size() || a[0].part != b[0].part) continue;
      const SurfacePoint s = surfaceOf(shape, ray, a[0]);
      if (std::abs(dot(s.normal, ray.direction)) < 0.2) continue;
      const SurfacePoint t = surfaceOf(shape, close, b[0]);
      if (length(t.normal - s.normal) > 1e-4) continue;  // the surface bends within the step, as at an apex
      EXPECT_NEAR(dot(t.point - s.point, s.normal), 0, 1e-9);
    }
  }
}

/// Its volume (checks of the courses, E1).
double volumeOver(const Shape& shape, int n) { return test::volume(shape, boundsOf(prepare(shape)), n); }

TEST(Shapes, VolumeByParallelProjection) {
  EXPECT_NEAR(volumeOver(Sphere{}, 500), 4.18879, 2e-4);
  EXPECT_NEAR(volumeOver(Cube{}, 100), 1, 1e-12);
  EXPECT_NEAR(volumeOver(Cylinder{}, 500), kPi, 2e-4);
  EXPECT_NEAR(volumeOver(Cone{}, 500), 1.04720, 2e-4);
  EXPECT_NEAR(volumeOver(Conic{.zMin = -1}, 500), 2 * 1.04720, 8e-4);
  EXPECT_NEAR(volumeOver(Cone{.height = 2, .bottomRadius = 1, .topRadius = 0.5}, 500),
              kPi * 2 * (1 + 0.5 + 0.25) / 3, 5e-4);
  EXPECT_NEAR(volumeOver(Torus{}, 500), 1.23370, 2e-4);
  EXPECT_NEAR(volumeOver(Torus{.minorRadius = 0.02}, 500), 2 * kPi * kPi * 0.02 * 0.02, 2e-5);
  EXPECT_NEAR(volumeOver(Ellipsoid{.radii = {1, 2, 3}}, 500), 25.13274, 2e-3);
  EXPECT_NEAR(volumeOver(Paraboloid{}, 500), 1.57080, 2e-4);
  EXPECT_NEAR(volumeOver(EllipticCone{.height = 2}, 500), kPi * 0.5 * 2 / 3, 2e-4);
  EXPECT_NEAR(volumeOver(Hyperboloid{}, 500), kPi * (0.5 + 0.5 * 1),
              5e-4);                                                     // a h + c h^3 / 12, a = 1/4, c = 3/4
  EXPECT_NEAR(volumeOver(TwoSheets{.gap = 0}, 500), 2 * kPi / 3, 5e-4);  // then a double cone
  EXPECT_NEAR(volumeOver(Quadric{.squares = {1, 0, 1}, .products = {}, .linear = {}, .constant = -1}, 500),
              2 * kPi, 5e-4);
  const double r = 0.1, inner = 0.8;
  EXPECT_NEAR(
      volumeOver(RoundedBox{}, 500),
      inner * inner * inner + 6 * inner * inner * r + 3 * kPi * inner * r * r + 4 * kPi / 3 * r * r * r,
      2e-4);
  const double third = 1.0 / 3;  // Pappus: a triangle with its centroid 4/3 from the axis
  EXPECT_NEAR(volumeOver(Lathe{{{1, 0}, {1.5, 0}, {1.5, 0.5}, {1, 0}}, Spline::linear}, 500),
              2 * kPi * (1 + third) * 0.125, 5e-4);
  EXPECT_NEAR(volumeOver(Lathe{{{1, 0}, {0, 1}}, Spline::linear}, 500), kPi / 3, 5e-4);
  const Prism::Outline square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
      hole{{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}};
  EXPECT_NEAR(volumeOver(Prism{square, {hole}, Spline::linear, 2, 1}, 400), (4 - 1) * 2, 1e-9);
  EXPECT_NEAR(volumeOver(Prism{square, {hole}, Spline::linear, 2, 0}, 400), (4 - 1) * 2 * third, 5e-4);
  EXPECT_NEAR(volumeOver(Prism{square, {hole}, Spline::linear, 2, 0.5, 200}, 150),
              (4 - 1) * 2 * (1 + 0.5 + 0.25) * third, 5e-3);
  EXPECT_NEAR(volumeOver(SphereSweep{{{0, 0, 0, 1}, {0, 0, 2, 1}}, Spline::linear}, 500),
              2 * kPi + 4 * kPi / 3, 1e-3);
  for (int level = 0; level < 4; ++level)
    EXPECT_NEAR(volumeOver(Menger{level}, 243), std::pow(20.0 / 27, level), 1e-12);
  for (int level = 0; level < 4; ++level)
    EXPECT_NEAR(volumeOver(Sierpinski{level}, 256), std::pow(0.5, level) / 3, 2e-4);
  EXPECT_NEAR(volumeOver(Supertoroid{.minorRadius = 0.25, .east = 1, .north = 1}, 300), 1.23370, 5e-4);
  EXPECT_NEAR(volumeOver(Supertoroid{.minorRadius = 0.25, .east = 1, .north = 2}, 300), 2 * kPi * 0.125,
              5e-4);
  for (const bool smooth : {false, true}) {  // a slope, down to z = -0.5
    HeightField slope;
    slope.formula = "0.3 * x - 0.2 * y + 0.1", slope.points = 8, slope.smooth = smooth;
    EXPECT_NEAR(volumeOver(slope, 200), 4 * 0.6, 1e-3);
  }
  Isosurface ball;
  ball.formula = "sqrt(x^2 + y^2 + z^2) - 1";
  EXPECT_NEAR(volumeOver(ball, 300), 4.18879, 1e-3);
  EXPECT_NEAR(volumeOver(Metaballs{0.25, {{0, 0, 0, 1, 1}}, {}}, 500), 4 * kPi / 3 * std::pow(0.5, 1.5),
              2e-4);
  EXPECT_NEAR(volumeOver(Superellipsoid{.east = 1, .north = 1}, 500), 4.18879, 2e-4);
  EXPECT_NEAR(volumeOver(Superellipsoid{.east = 2, .north = 2}, 500), 4.0 / 3, 2e-4);
  EXPECT_NEAR(volumeOver(Superellipsoid{.east = 1, .north = 2}, 500), 2 * kPi / 3, 1e-3);
}

/// Mean chord of uniform isotropic lines that meet a convex body: 4 V / S (Cauchy).
double meanChord(const Shape& plain, Random& random) {
  const TracedShape shape = prepare(plain);
  const Vec3 center = boundsOf(shape).center();
  const Real radius = 0.5 * length(boundsOf(shape).size()) * 1.01;
  double sum = 0;
  int met = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Vec3 d = random.direction();
    const Vec3 side = normalize(cross(d, std::abs(d.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const Real r = radius * std::sqrt(random.uniform()), phi = random.uniform(0, 2 * kPi);
    const Vec3 p = center + side * (r * std::cos(phi)) + cross(d, side) * (r * std::sin(phi));
    const auto c = crossingsOf(shape, {p - d * (2 * radius), d});
    if (c.size() == 2) sum += c[1].t - c[0].t, ++met;
  }
  return sum / met;
}

TEST(Shapes, MeanChordOfConvexBodies) {
  Random random(5);
  EXPECT_NEAR(meanChord(Sphere{}, random), 4.0 / 3, 2e-3);
  EXPECT_NEAR(meanChord(Cube{}, random), 2.0 / 3, 2e-3);
  // An oblate spheroid with half axes 1 and 1/2.
  const double e = std::sqrt(0.75), area = 2 * kPi * (1 + 0.25 / e * std::atanh(e));
  EXPECT_NEAR(meanChord(Ellipsoid{.radii = {1, 1, 0.5}}, random), 4 * (2 * kPi / 3) / area, 2e-3);
  EXPECT_NEAR(meanChord(Cylinder{}, random), 4 * kPi / (4 * kPi), 2e-3);  // r = 1, h = 1: V = pi, S = 4 pi
  EXPECT_NEAR(meanChord(Cone{}, random), 4 * (kPi / 3) / (kPi * (1 + std::sqrt(2.0))), 2e-3);
}

TEST(Shapes, RaysThroughTheCentreOfSymmetricSolids) {
  Random random(6);
  for (const Shape& plain :
       {Shape(Sphere{}), Shape(Cube{}), Shape(Ellipsoid{}), Shape(RoundedBox{}), Shape(Superellipsoid{})}) {
    const TracedShape shape = prepare(plain);
    for (int i = 0; i < 1000; ++i) {
      const Ray ray{{}, random.direction()};
      const auto c = crossingsOf(shape, ray);
      ASSERT_EQ(c.size(), 2u);
      EXPECT_NEAR(c[0].t, -c[1].t, 1e-15);
      EXPECT_LT(length(surfaceOf(shape, ray, c[0]).normal + surfaceOf(shape, ray, c[1]).normal), 1e-14);
    }
  }
}

TEST(Julia, WithoutAConstantIsABall) {
  Random random(9);
  for (const Real offset : {0.0, 0.6}) {
    Julia julia;
    julia.constant = {}, julia.iterations = 30, julia.offset = offset;
    const TracedShape shape = prepare(Shape(julia));
    for (int i = 0; i < 100; ++i) {
      const Vec3 d = random.direction();
      const auto c = crossingsOf(shape, {d * 3, -d});
      ASSERT_EQ(c.size(), 2u);
      EXPECT_NEAR(3 - c[0].t, std::sqrt(1 - offset * offset), 1e-8);
    }
  }
}

TEST(Isosurface, FindsShellsThinnerThanAnyStep) {
  Isosurface shell;
  shell.formula = "abs(sqrt(x^2 + y^2 + z^2) - 1) - 0.00001";
  Random random(10);
  for (int i = 0; i < 200; ++i) {
    const Vec3 target = random.inCube(0.5);
    const Vec3 d = random.direction();
    EXPECT_EQ(crossingsOf(shell, {target - d * 5, d}).size(), 4u);
  }
}

TEST(Shapes, RaysAlongAxesAndInFacesGiveNoNaN) {
  const Real values[] = {-2, -1, -0.5, 0, 0.5, 1, 2};
  for (const Shape& plain : analyticShapes()) {
    const TracedShape shape = prepare(plain);
    const int share = 100 / raysFor(plain, 100);
    int place = 0;
    for (Real x : values)
      for (Real y : values)
        for (Real z : values) {
          if (place++ % share != 0) continue;
          for (const Vec3& d :
               {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 1, -1}, Vec3{1, 1, 1}}) {
            const Ray ray{{x, y, z}, d};
            for (const Crossing& c : placesOf(shape, ray)) {
              const SurfacePoint s = surfaceOf(shape, ray, c);
              EXPECT_TRUE(std::isfinite(c.t) && isFinite(s.point) && isFinite(s.normal) && isFinite(s.error))
                  << nameOf(plain);
            }
          }
        }
  }
}

TEST(Shapes, ConeWithEqualRadiiIsACylinder) {
  Random random(7);
  const Cone cone{.height = 1, .bottomRadius = 1, .topRadius = 1};
  for (int i = 0; i < kRays; ++i) {
    const Ray ray = rayToward(boundsOf(prepare(cone)), random);
    const auto a = crossingsOf(cone, ray), b = crossingsOf(Cylinder{}, ray);
    ASSERT_EQ(a.size(), b.size());
    for (size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].t, b[k].t);
  }
}

TEST(Conic, IsTheConeThatBeginsAtZero) {
  Random random(8);
  const Cone cone{.height = 2, .bottomRadius = 1, .topRadius = 0.5};
  const Conic conic{.bottomRadius = 1, .topRadius = 0.5, .zMin = -4, .zMax = -2};
  for (int i = 0; i < kRays; ++i) {
    const Ray ray = rayToward(boundsOf(prepare(cone)), random);
    const Ray below{ray.origin - Vec3{0, 0, 4}, ray.direction};
    const auto a = crossingsOf(cone, ray), b = crossingsOf(conic, below);
    ASSERT_EQ(a.size(), b.size());
    for (size_t k = 0; k < a.size(); ++k) {
      EXPECT_NEAR(a[k].t, b[k].t, 1e-6);  // grazing rays lose half of the digits
      EXPECT_LT(length(surfaceOf(cone, ray, a[k]).normal - surfaceOf(conic, below, b[k]).normal), 1e-6);
    }
  }
}

TEST(Plane, IsTheBoundaryOfTheSpaceBelow) {
  const auto down = crossingsOf(Plane{}, {{1.25, 2.5, 3}, {0, 0, -2}});
  ASSERT_EQ(down.size(), 2u);
  EXPECT_EQ(down[0].t, 1.5);
  EXPECT_EQ(down[1].t, kInfinity);
  const Ray up{{1.25, -2.5, -3}, {0, 0, 1}};
  const auto out = crossingsOf(Plane{}, up);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].t, -kInfinity);
  EXPECT_EQ(out[1].t, 3);
  const SurfacePoint s = surfaceOf(Plane{}, up, out[1]);
  EXPECT_EQ(s.normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(Vec2(s.uv), (Vec2{0.25, 0.5}));
  EXPECT_EQ(crossingsOf(Plane{}, {{0, 0, 1}, {1, 0, 0}}).size(), 0u);
  EXPECT_EQ(crossingsOf(Plane{}, {{0, 0, -1}, {1, 0, 0}}).size(), 2u);
  EXPECT_EQ(crossingsOf(Plane{}, {{0, 0, 1}, {1, 0, -1e-320}}).size(), 0u);  // farther than numbers reach
}

TEST(Onward, IsTheNextNumber) {
  Random random(1);
  for (int i = 0; i < 1000000; ++i) {
    const Real x = std::ldexp(i % 3 == 0 ? 1.0 : random.uniform(1, 2), random.below(1900) - 900) *
                   (random.coin() ? 1 : -1),
               move = random.uniform(-1, 1);
    ASSERT_EQ(onward(x, move), std::nextafter(x, std::copysign(kInfinity, move))) << x;
    ASSERT_EQ(onward(x, 0), x);
  }
  for (const Real x : {0.0, 1e-308, -1e-320}) {
    EXPECT_GT(onward(x, 1), x);
    EXPECT_LT(onward(x, -1), x);
    EXPECT_LT(onward(x, 1) - x, 1e-300);
  }
}

TEST(Cube, TextureCoordinatesMirrorOnTheLowFaces) {
  const Ray fromRight{{2, 0.1, 0.2}, {-1, 0, 0}}, fromLeft{{-2, 0.1, 0.2}, {1, 0, 0}};
  const Vec2 right = surfaceOf(Cube{}, fromRight, crossingsOf(Cube{}, fromRight)[0]).uv;
  const Vec2 left = surfaceOf(Cube{}, fromLeft, crossingsOf(Cube{}, fromLeft)[0]).uv;
  EXPECT_NEAR(right.x, 0.6, 1e-15);
  EXPECT_NEAR(right.y, 0.7, 1e-15);
  EXPECT_NEAR(left.x, 0.4, 1e-15);
  EXPECT_NEAR(left.y, 0.7, 1e-15);
}

}  // namespace
}  // namespace trace::test
