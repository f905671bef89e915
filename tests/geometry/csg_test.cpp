// Union, intersection, difference and clip.
#include "geometry/shapes/solids/csg.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

Operand operandAt(const Shape& shape, const Affine& place = {}, std::uint32_t material = 0) {
  return {"", shape, place, material};
}
Affine movedBy(Real x, Real y, Real z) { return Affine::translation({x, y, z}); }

const Box3 kUnit{{-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}};

/// The cylinder of radius 1 from -2 to 2, along an axis.
Operand cylinder(int axis) {
  Affine along = Affine::scaling({1, 1, 4}) * movedBy(0, 0, -0.5);
  if (axis == 0) along = Affine::rotation({0, 1, 0}, kPi / 2) * along;
  if (axis == 1) along = Affine::rotation({1, 0, 0}, kPi / 2) * along;
  return operandAt(Cylinder{}, along);
}

TEST(Csg, VolumesOfTheCourses) {
  EXPECT_NEAR(volume(Intersection{Operands({cylinder(0), cylinder(1)})}, kUnit, 500), 16.0 / 3, 2e-3);
  EXPECT_NEAR(volume(Intersection{Operands({cylinder(0), cylinder(1), cylinder(2)})}, kUnit, 500),
              8 * (2 - std::sqrt(2.0)), 2e-3);
  EXPECT_NEAR(volume(Intersection{Operands({operandAt(Sphere{}, movedBy(-0.5, 0, 0)),
                                            operandAt(Sphere{}, movedBy(0.5, 0, 0))})},
                     kUnit, 500),
              1.30900, 1e-3);
}

TEST(Csg, VolumesOfRandomTreesAddUp) {
  Random random(1);
  const auto shapes = analyticShapes();
  for (int i = 0; i < 10; ++i) {
    const auto any = [&]() -> Operand {
      for (;;) {
        const Shape& shape = shapes[static_cast<size_t>(random.below(static_cast<int>(shapes.size())))];
        if (isSolid(prepare(shape)) && !boundsOf(prepare(shape)).unbounded())
          return operandAt(
              shape, Affine::rotation(random.direction(), 1) * movedBy(random.uniform(-0.5, 0.5), 0, 0));
      }
    };
    const Operand a = any(), b = any(), c = any();
    const Operand ab = operandAt(Difference{Operands({b, c})});
    const Box3 box{{-4, -4, -4}, {4, 4, 4}};
    const auto v = [&](const Shape& s) { return volume(s, box, 60); };
    const double both = v(Intersection{Operands({a, ab})});
    EXPECT_NEAR(v(Union{Operands({a, ab})}) + both, v(Union{Operands({a})}) + v(Union{Operands({ab})}), 1e-9);
    EXPECT_NEAR(v(Difference{Operands({a, ab})}), v(Union{Operands({a})}) - both, 1e-9);
  }
}

TEST(Csg, PlanesCutInAnyPlace) {
  for (const Affine& place : {Affine{}, Affine::rotation({0.3, 1, 0.2}, 1.3)}) {
    const Intersection half{Operands({operandAt(Sphere{}), operandAt(Plane{}, place)})};
    EXPECT_EQ(boundsOf(prepare(Shape(half))), boundsOf(prepare(Shape(Sphere{}))));
    EXPECT_NEAR(volume(half, kUnit, 200), 2 * kPi / 3, 2e-3);
    EXPECT_NEAR(volume(Difference{Operands({operandAt(Sphere{}), operandAt(Plane{}, place)})}, kUnit, 200),
                2 * kPi / 3, 2e-3);
  }
}

TEST(Csg, CoincidentFacesAreOneOrNone) {
  const Operand box = operandAt(Cube{}), beside = operandAt(Cube{}, movedBy(1, 0, 0));
  const Ray along{{-3, 0.1, 0.2}, {1, 0, 0}};
  EXPECT_EQ(crossingsOf(Union{Operands({box, beside})}, along).size(), 2u);  // no wall between
  EXPECT_EQ(crossingsOf(Intersection{Operands({box, beside})}, along).size(), 0u);
  EXPECT_EQ(crossingsOf(Union{Operands({box, box})}, along).size(), 2u);
  EXPECT_EQ(crossingsOf(Intersection{Operands({box, box})}, along).size(), 2u);
  EXPECT_EQ(crossingsOf(Difference{Operands({box, box})}, along).size(), 0u);
  // Drilled right through, flush with both faces: nothing is left over the hole.
  const Operand drill = operandAt(Cylinder{}, movedBy(0, 0, -0.5) * Affine::scaling({0.3, 0.3, 1}));
  EXPECT_EQ(crossingsOf(Difference{Operands({box, drill})}, {{0.1, 0.1, 3}, {0, 0, -1}}).size(), 0u);
  // The first operand's face is the one seen.
  const auto seen = crossingsOf(Union{Operands({operandAt(Cube{}, {}, 7), operandAt(Cube{}, {}, 8)})}, along);
  const auto tree = Union{Operands({operandAt(Cube{}, {}, 7), operandAt(Cube{}, {}, 8)})}.prepared();
  EXPECT_EQ(tree->material(seen[0].part, 0).material[0], 7u);
}

TEST(Csg, FlushFacesUnderAnyTransform) {
  // The same drilled block and the same pair of blocks, turned, scaled and moved: rounding separates the
  // faces.
  Random random(2);
  int through = 0;
  for (int i = 0; i < 2000; ++i) {
    const Affine m = random.affine(std::pow(10, random.uniform(-4, 6)));
    const Affine drill = movedBy(0, 0, -0.5) * Affine::scaling({0.3, 0.3, 1});
    const TracedShape drilled =
        prepare(Shape(Difference{Operands({operandAt(Cube{}, m), operandAt(Cylinder{}, m * drill)})}));
    const Vec3 start = m * Vec3{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 3};
    const Vec3 end = m * Vec3{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), -3};
    EXPECT_EQ(crossingsOf(drilled, {start, end - start}).size() % 2, 0u);
    const Vec3 straight = linear(m, {0, 0, -1});
    through += crossingsOf(drilled, {start, straight}).empty();
    const TracedShape pair =
        prepare(Shape(Union{Operands({operandAt(Cube{}, m), operandAt(Cube{}, m * movedBy(1, 0, 0))})}));
    const Vec3 left = m * Vec3{-3, random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)};
    EXPECT_EQ(crossingsOf(pair, {left, linear(m, {1, 0, 0})}).size(), 2u);
  }
  EXPECT_EQ(through, 2000);
}

TEST(Csg, LargeUnionsMeetWhatTheirPartsMeet) {
  Random random(3);
  std::vector<Operand> all;
  for (std::uint32_t i = 0; i < 200; ++i)
    all.push_back(
        operandAt(Sphere{}, Affine::translation(random.inCube(3)) * Affine::scaling({0.3, 0.3, 0.3}), i));
  const Union whole{Operands(all)};
  const TracedShape traced = prepare(Shape(whole));
  for (int i = 0; i < 5000; ++i) {
    const Ray ray{random.inCube(4), random.direction()};
    std::vector<std::pair<Real, int>> ends;
    for (const Operand& o : all)
      for (const Crossing& c : crossingsOf(Union{Operands({o})}, ray))
        ends.push_back(
            {c.t, dot(surfaceOf(Union{Operands({o})}, ray, c).normal, ray.direction) < 0 ? 1 : -1});
    std::sort(ends.begin(), ends.end());
    int inside = 0;
    std::vector<Real> expected;
    for (const auto& [t, change] : ends) {
      if ((inside > 0) != (inside + change > 0)) expected.push_back(t);
      inside += change;
    }
    const auto found = crossingsOf(traced, ray);
    ASSERT_EQ(found.size(), expected.size());
    for (size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].t, expected[k]);
  }
}

TEST(Csg, CutFacesTurnOutwardAndKeepTheirOperandsMaterial) {
  const Difference shape{
      Operands({operandAt(Cube{}, {}, 1),
                operandAt(Sphere{}, movedBy(0, 0, 0.5) * Affine::scaling({0.4, 0.4, 0.4}), 2)})};
  const Ray down{{0.05, 0, 3}, {0, 0, -1}};
  const auto c = crossingsOf(shape, down);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_GT(surfaceOf(shape, down, c[0]).normal.z, 0.9);
  EXPECT_EQ(shape.prepared()->material(c[0].part, 0).material[0], 2u);
  EXPECT_EQ(shape.prepared()->material(c[1].part, 0).material[0], 1u);
}

// A query stops where the line has left a solid that is needed, and beyond its end.
TEST(Csg, ARayMeetsAheadWhatItsLineMeets) {
  const Operands operands({operandAt(Cube{}, Affine::scaling({1.4, 1.4, 1.4})),
                           operandAt(Sphere{}, Affine::scaling({0.9, 0.9, 0.9})), cylinder(2)});
  Random random(5);
  for (const Shape& shape : {Shape(Union{operands}), Shape(Intersection{operands}),
                             Shape(Difference{operands}), Shape(Clip{operands})}) {
    const TracedShape traced = prepare(shape);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray{random.direction() * random.uniform(0, 3), random.direction()};
      const Real end = random.uniform(0, 4);
      const auto isWanted = [&](const Crossing& c) { return c.t > 0 && c.t <= end; };
      std::vector<Crossing> wanted = crossingsOf(traced, ray), found;
      std::erase_if(wanted, [&](const Crossing& c) { return !isWanted(c); });
      const auto add = [&](const Crossing& c) {
        if (isWanted(c)) found.push_back(c);
      };
      traced.crossings(ray, Range{0, end}, add);
      ASSERT_EQ(found.size(), wanted.size()) << nameOf(shape) << ' ' << i;
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k].t, wanted[k].t);
        EXPECT_EQ(found[k].part, wanted[k].part);
      }
    }
  }
}

TEST(Csg, ClippedObjectsStayOpen) {
  const Clip shape{
      Operands({operandAt(Sphere{}), operandAt(Cube{}, movedBy(0, 0, 0.5) * Affine::scaling({3, 3, 1}))})};
  EXPECT_FALSE(isSolid(shape));
  const Ray up{{0.1, 0, -3}, {0, 0, 1}};  // through the open bottom to the inside of the dome
  const auto c = crossingsOf(shape, up);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_LT(surfaceOf(shape, up, c[0]).normal.z, 0);
}

TEST(Csg, ASheetThatIsMetOnceIsClippedToo) {
  const Clip shape{Operands({operandAt(Square{}), operandAt(Cube{}, movedBy(0.4, 0, 0))})};
  EXPECT_EQ(crossingsOf(shape, Ray{{0.2, 0, -3}, {0, 0, 1}}).size(), 1u);
  EXPECT_EQ(crossingsOf(shape, Ray{{-0.2, 0, -3}, {0, 0, 1}}).size(), 0u);
}

TEST(Csg, MeshesAreOperands) {
  Random random(4);
  const Mesh ball{ballMesh(12, random)};
  const Box3 box{{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}};
  const double whole = volume(Union{Operands({operandAt(ball)})}, box, 200);
  const Operand half = operandAt(Cube{}, movedBy(0, 0, 1) * Affine::scaling({4, 4, 2}));
  EXPECT_GT(whole, 2);
  EXPECT_NEAR(volume(Intersection{Operands({operandAt(ball), half})}, box, 200) +
                  volume(Difference{Operands({operandAt(ball), half})}, box, 200),
              whole, 1e-9);
}

TEST(Csg, TooDeepANestIsRefused) {
  Operand nest = operandAt(Sphere{});
  EXPECT_THROW(
      for (int i = 0; i < 100; ++i) {
        nest = operandAt(Union{Operands({nest, operandAt(Sphere{})})});
        prepare(nest.shape);
      },
      Error);
}

}  // namespace
}  // namespace trace::test
