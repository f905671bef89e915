// Solids joined by fillets.
#include "geometry/shapes/solids/blend.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "geometry/materials.h"
#include "geometry/shapes/fractals/menger.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

Affine move(Real x, Real y, Real z) { return Affine::translation({x, y, z}); }
Operand at(const Shape& shape, const Affine& place = {}, std::uint32_t material = 0) {
  return {"", shape, place, material};
}
Blend blend(CsgOperation operation, Real radius, std::vector<Operand> objects) {
  Blend b;
  b.operation = operation, b.radius = radius, b.objects = Operands(std::move(objects));
  return b;
}
/// A floor below z = 0 and a wall behind x = 0.
std::vector<Operand> floorAndWall() {
  const Affine wide = Affine::scaling({8, 8, 8});
  return {at(Cube{}, move(0, 0, -4) * wide, 1), at(Cube{}, move(-4, 0, 0) * wide, 2)};
}

TEST(Blend, FilletIsAQuarterOfACircle) {
  Random random(1);
  const Shape corner = blend(CsgOperation::unite, 0.5, floorAndWall());
  const TracedShape shape = prepare(corner);
  for (int i = 0; i < 200; ++i) {
    // From the fillet's axis into the corner.
    const Real angle = random.uniform(0.01, 0.49) * kPi, along = random.uniform(-1, 1);
    const Vec3 d = Vec3{-std::cos(angle), random.uniform(-0.2, 0.2), -std::sin(angle)};
    const auto c = crossingsOf(shape, {{0.5, along, 0.5}, d});
    ASSERT_GE(c.size(), 1u);
    const auto ahead = std::find_if(c.begin(), c.end(), [](const Crossing& x) { return x.t > 0; });
    ASSERT_NE(ahead, c.end());
    EXPECT_NEAR(ahead->t, 0.5, 1e-12);  // the direction is of length 1 across the axis
    const SurfacePoint s = surfaceOf(shape, {{0.5, along, 0.5}, d}, *ahead);
    EXPECT_NEAR(dot(s.normal, {-d.x, 0, -d.z}), 1, 1e-9);
  }
}

TEST(Blend, OfStretchedSolidsIsWhollyInItsBounds) {
  // Four times as long as they are thick, so that the fillet at their ends reaches farther than its radius
  // says: where both are 1 - sqrt(1/2) away.
  const Affine stretched = Affine::scaling({4, 0.25, 0.25});
  const Shape twins =
      blend(CsgOperation::unite, 1,
            {at(Sphere{}, move(0, 0.2, 0) * stretched), at(Sphere{}, move(0, -0.2, 0) * stretched)});
  const Real away = 1 + (1 - std::sqrt(0.5)) / std::cbrt(0.25);
  const Real end = 4 * std::sqrt(away * away - 0.64);
  const auto met = crossingsOf(prepare(twins), {{10, 0, 0}, {-1, 0, 0}});
  ASSERT_EQ(met.size(), 2u);
  EXPECT_NEAR(met[0].t, 10 - end, 1e-9);
  EXPECT_NEAR(met[1].t, 10 + end, 1e-9);
  // What is cut to a fillet gets no larger.
  const auto cut =
      blend(CsgOperation::intersect, 0.5, {at(Sphere{}), at(Cube{}, Affine::scaling({4, 4, 4}))});
  EXPECT_EQ(cut.prepared()->bounds(), (Box3{{-1, -1, -1}, {1, 1, 1}}));
}

TEST(Blend, LeadsFromOneMaterialToTheOther) {
  const Blend corner = blend(CsgOperation::unite, 0.5, floorAndWall());
  const auto traced = corner.prepared();
  const auto shareAt = [&](Real angle) {
    const Ray ray{{0.5, 0, 0.5}, {-std::cos(angle), 0, -std::sin(angle)}};
    for (const Crossing& c : crossingsOf(corner, ray))
      if (c.t > 0) return traced->material(c.part, 0);
    return MaterialMix{};
  };
  EXPECT_EQ(shareAt(0.3).material[0], 1u);
  EXPECT_EQ(shareAt(0.3).material[1], 2u);
  EXPECT_GT(shareAt(0.3).weight[1], 0.5);  // nearer the wall
  EXPECT_LT(shareAt(1.3).weight[1], 0.5);
  EXPECT_NEAR(shareAt(kPi / 4).weight[1], 0.5, 2e-3);
  std::vector<std::uint32_t> all;
  traced->addMaterials(all);
  EXPECT_EQ(all, (std::vector<std::uint32_t>{1, 2}));
}

TEST(Blend, OfRadiusZeroIsCsg) {
  Random random(2);
  const std::vector<Operand> objects{at(RoundedBox{}, Affine::scaling({1.5, 1.5, 1.5})),
                                     at(Sphere{}, move(0.4, 0.3, 0.5) * Affine::scaling({0.7, 0.7, 0.7})),
                                     at(Torus{}, Affine::rotation({1, 0, 0}, 0.4)),
                                     at(Cylinder{}, move(0, 0, -1) * Affine::scaling({0.3, 0.3, 2})),
                                     at(Ellipsoid{}, move(-0.5, 0, 0)),
                                     at(Conic{.bottomRadius = 0.6, .topRadius = 0.2, .zMin = -1, .zMax = 1})};
  const auto compare = [&](const Shape& smooth, const Shape& plain) {
    const TracedShape a = prepare(smooth), b = prepare(plain);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 d = random.direction();
      const Ray ray{random.inCube(1.2) - d * 5, d};
      const auto p = crossingsOf(a, ray), q = crossingsOf(b, ray);
      if (p.size() != q.size()) {  // only where the ray touches an edge
        Real closest = kInfinity;
        const auto& longer = p.size() > q.size() ? p : q;
        for (std::size_t k = 0; k + 1 < longer.size(); ++k)
          closest = std::min(closest, longer[k + 1].t - longer[k].t);
        EXPECT_LT(closest, 1e-6);
        continue;
      }
      for (std::size_t k = 0; k < p.size(); ++k) EXPECT_NEAR(p[k].t, q[k].t, 1e-7);
    }
  };
  compare(blend(CsgOperation::unite, 0, objects), Union{Operands(objects)});
  compare(blend(CsgOperation::intersect, 0, {objects[0], objects[1]}),
          Intersection{Operands({objects[0], objects[1]})});
  compare(blend(CsgOperation::subtract, 0, {objects[0], objects[1], objects[3]}),
          Difference{Operands({objects[0], objects[1], objects[3]})});
}

TEST(Blend, TakesBlendsAndSolidsOfSolids) {
  const Blend inner = blend(CsgOperation::unite, 0.1, {at(Sphere{}), at(Sphere{}, move(1, 0, 0))});
  const Difference cut{Operands({at(Cube{}), at(Sphere{}, move(0.5, 0.5, 0.5))})};
  const SphereSweep capsule{{{0, 0, 0, 0.2}, {0, 1, 0, 0.2}, {1, 1, 0, 0.2}}, Spline::linear};
  const Shape whole =
      blend(CsgOperation::unite, 0.2, {at(inner), at(cut, move(0, 0, 1.2)), at(capsule, move(0, 1, 0))});
  EXPECT_GT(volume(whole, boundsOf(prepare(whole)), 60), 4 * kPi / 3 * 1.5);
}

TEST(Blend, RefusesWhatHasNoDistanceOrNoEnd) {
  const auto refused = [](const Blend& b) {
    try {
      b.prepared();
    } catch (const Error& error) {
      return error.messages().front().what;
    }
    return std::string();
  };
  EXPECT_NE(refused(blend(CsgOperation::unite, 0.1, {at(Menger{}), at(Sphere{})})).find("menger"),
            std::string::npos);
  EXPECT_NE(refused(blend(CsgOperation::unite, 0.1, {at(Sphere{}), at(Plane{})})).find("infinite"),
            std::string::npos);
  EXPECT_EQ(refused(blend(CsgOperation::subtract, 0.1, {at(Sphere{}), at(Plane{})})), "");
}

}  // namespace
}  // namespace trace::test
