// Where fur grows, and what bends it.
#include "geometry/shapes/surfaces/fur.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

Fur furOn(const Shape& shape, const Affine& place = {}) {
  Fur fur;
  fur.objects = Operands({{"", shape, place, 0}});
  fur.count = 200, fur.spread = 0, fur.lengthSpread = 0, fur.length = 0.5;
  return fur;
}

/// The roots and tips of what grows, as rays along an axis meet it from above and from below.
Box3 furBox(const Fur& fur) { return boundsOf(prepare(Shape(fur))); }

TEST(Fur, StandsOnTheSurfaceAsLongAsWanted) {
  const Box3 box = furBox(furOn(Sphere{}));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.high[axis], 1.5, 0.06);
    EXPECT_NEAR(box.low[axis], -1.5, 0.06);
  }
  const Box3 above = furBox(furOn(Square{}, Affine::scaling({4, 4, 1})));
  EXPECT_NEAR(above.high.z, 0.5, 0.01) << "a sheet has fur on both sides";
  EXPECT_NEAR(above.low.z, -0.5, 0.01);
}

TEST(Fur, GrowsEvenlyOverAllObjects) {
  // Of two balls one has four times the surface, and so four times the strands.
  Fur fur;
  fur.count = 4000, fur.length = 0.001, fur.width = fur.tipWidth = 0.02, fur.spread = 0;
  fur.objects = Operands({{"", Sphere{}, Affine::translation({-10, 0, 0}), 0},
                          {"", Sphere{}, Affine::translation({10, 0, 0}) * Affine::scaling({2, 2, 2}), 0}});
  const TracedShape shape = prepare(fur);
  Random random(1);
  const auto share = [&](const Vec3& center, Real radius) {
    int hits = 0;
    const int rays = 20'000;
    for (int i = 0; i < rays; ++i) {
      const Vec3 d = random.direction();
      const Ray inward{center + d * (radius + 0.5), -d};
      const auto met = crossingsOf(shape, inward);
      hits += !met.empty() && met[0].t < 1;
    }
    return static_cast<Real>(hits) / rays;
  };
  const Real small = share({-10, 0, 0}, 1), large = share({10, 0, 0}, 2);
  EXPECT_GT(small, 0.01);
  EXPECT_NEAR(small / large, 1, 0.15) << "the same number to each unit of area";
}

TEST(Fur, HangsAndDoesNotEnterItsObject) {
  Fur fur = furOn(Sphere{});
  fur.length = 3, fur.gravity = {0, 0, -30};
  const Box3 box = furBox(fur);
  EXPECT_LT(box.low.z, -3);
  EXPECT_LT(box.high.z, 1.6) << "only the first step stands up";
  fur.width = fur.tipWidth = 0.01;
  const TracedShape hanging = prepare(fur);
  Random random(2);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = random.direction();
    for (const Crossing& c : crossingsOf(hanging, {Vec3{} - d * 0.9, d})) inside += c.t > 0 && c.t < 1.8;
  }
  EXPECT_LE(inside, 20) << "strands slide along the ball";
}

TEST(Fur, GrowsOnMeshesAndSlidesAlongThem) {
  Random shape(6);
  Fur fur = furOn(Mesh{ballMesh(12, shape)});
  fur.length = 3, fur.gravity = {0, 0, -30}, fur.width = fur.tipWidth = 0.01;
  const TracedShape hanging = prepare(fur);
  EXPECT_LT(boundsOf(hanging).low.z, -3);
  Random random(7);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = random.direction();
    for (const Crossing& c : crossingsOf(hanging, {Vec3{} - d * 0.6, d})) inside += c.t > 0 && c.t < 1.2;
  }
  EXPECT_LE(inside, 20);
}

TEST(Fur, IsTheSameForTheSameSeedAndKeepsStrandsWhereMoreGrow) {
  Fur fur = furOn(Sphere{});
  const auto seen = [](const Fur& f) {
    const TracedShape shape = prepare(f);
    Random random(3);
    std::vector<std::int64_t> parts;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 d = random.direction();
      for (const Crossing& c : crossingsOf(shape, {random.inCube(1) - d * 5, d})) parts.push_back(c.part);
    }
    return parts;
  };
  EXPECT_EQ(seen(fur), seen(fur));
  Fur other = fur;
  other.seed = 2;
  EXPECT_NE(seen(fur), seen(other));
  fur.count = 50;
  Fur more = fur;
  more.count = 100;
  const TracedShape few = prepare(fur), many = prepare(more);
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = random.direction();
    const Ray ray{random.inCube(1) - d * 5, d};
    for (const Crossing& c : crossingsOf(few, ray)) {
      bool found = false;
      for (const Crossing& m : crossingsOf(many, ray)) found = found || m.part == c.part;
      EXPECT_TRUE(found);
    }
  }
}

TEST(Fur, ClumpsDrawTipsTogether) {
  Fur fur = furOn(Square{}, Affine::scaling({4, 4, 1}));
  fur.count = 500, fur.clumps = 1, fur.clumping = 1;
  fur.width = fur.tipWidth = 0.01;
  const TracedShape shape = prepare(fur);
  Random random(5);
  const auto met = [&](Real z) {
    int hits = 0;
    for (int i = 0; i < 4000; ++i)
      hits += !crossingsOf(shape, {{-5, random.uniform(-2, 2), z}, {1, 0, 0}}).empty();
    return hits;
  };
  EXPECT_LT(4 * met(0.47), met(0.02)) << "all end at one point";
}

TEST(Fur, NeedsObjectsWithAnEnd) {
  EXPECT_THROW(prepare(furOn(Plane{})), Error);
  EXPECT_THROW(check(furOn(Sphere{}, Affine::scaling({1, 1, 0}))), Error);
  EXPECT_TRUE(boundsOf(prepare(Shape(Fur{}))).empty());
}

}  // namespace
}  // namespace trace::test
