// Triangles for the interactive view lie on the shape and cover it.
#include "geometry/mesh/tessellate.h"

#include <gtest/gtest.h>

#include "base/looks.h"
#include "base/match.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/fractals/mandelbulb.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/shapes/surfaces/isosurface.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

/// Twice the area of all triangles as seen along the axis, each counted from either side.
double shadowAlong(const std::vector<SurfaceCorner>& corners, int axis) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3)
    sum += std::abs(
        cross(corners[i + 1].point - corners[i].point, corners[i + 2].point - corners[i].point)[axis]);
  return sum;
}

/// The same from the crossings of parallel rays.
double crossingsAlong(const Shape& shape, const Box3& box, int axis) {
  constexpr int kRows = 200;
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const TracedShape traced = prepare(shape);
  double count = 0;
  for (int a = 0; a < kRows; ++a)
    for (int b = 0; b < kRows; ++b) {
      Ray ray;
      ray.origin[axis] = box.low[axis] - 1;
      ray.origin[j] = box.low[j] + box.size()[j] * (a + 0.5) / kRows;
      ray.origin[k] = box.low[k] + box.size()[k] * (b + 0.5) / kRows;
      ray.direction[axis] = 1;
      count += static_cast<double>(crossingsOf(traced, ray).size());
    }
  return 2 * count * box.size()[j] * box.size()[k] / (kRows * kRows);
}

TEST(Tessellate, EveryShapeHasTrianglesWithinItsBounds) {
  for (const Shape& shape : analyticShapes()) {
    const auto corners = tessellate(shape, 10);
    const std::string_view name = shape.keyword();
    ASSERT_FALSE(corners.empty()) << name;
    const Box3 bounds = drawnBounds(shape);
    const double size = maxComponent(bounds.size());
    for (const SurfaceCorner& corner : corners) {
      EXPECT_NEAR(length(corner.normal), 1, 1e-9) << name;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(corner.point[axis], bounds.low[axis] - 0.1 * size) << name;
        EXPECT_LE(corner.point[axis], bounds.high[axis] + 0.1 * size) << name;
      }
    }
  }
}

TEST(Tessellate, ShapesHaveTheirBoundsAndTheirArea) {
  const std::vector<Shape> shapes{Sphere{}, Cube{}, Square{}, Cylinder{}, Cone{}, Ellipsoid{}, RoundedBox{}};
  for (const Shape& shape : shapes) {
    const auto corners = tessellate(shape, 32);
    const std::string_view name = shape.keyword();
    Box3 box;
    for (const SurfaceCorner& corner : corners) box.extend(corner.point);
    const Box3 bounds = boundsOf(prepare(shape));
    const double size = maxComponent(bounds.size());
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(box.low[axis], bounds.low[axis], 0.02 * size) << name;
      EXPECT_NEAR(box.high[axis], bounds.high[axis], 0.02 * size) << name;
      const double expected = crossingsAlong(shape, bounds, axis);
      EXPECT_NEAR(shadowAlong(corners, axis), expected, 0.06 * size * size) << name << " along axis " << axis;
    }
  }
}

/// A function that changes its sign a billion times along each line, by itself and in solids.
TEST(Tessellate, WhatNoGridFollowsIsGivenUp) {
  Isosurface waves;
  waves.formula = "sin(1000000000*x*y*z)";
  const Shape folded(waves);
  const Operands operands({{"", Sphere{}, {}, 0}, {"", folded, {}, 0}});
  for (const Shape& shape : {folded, Shape(Intersection{operands})}) {
    const std::int64_t before = looksAtBudget();
    EXPECT_TRUE(tessellate(shape, 64).empty()) << shape.keyword();
    EXPECT_LT(looksAtBudget() - before, 20000)
        << shape.keyword();  // a whole grid of such lines takes millions
  }
}

TEST(Tessellate, AFractalOfManyIterationsHasFewerSteps) {
  const std::int64_t before = looksAtBudget();
  int followed = 0;
  const Shape shape(Mandelbulb{.iterations = 30, .materials = {}});
  EXPECT_GT(tessellate(shape, 64, kFarthest, &followed).size(), 300u);
  EXPECT_LT(looksAtBudget() - before, 300000);  // with 64 steps it would be a million
  EXPECT_GE(followed, 8);
  EXPECT_LT(followed, 64);
}

TEST(Tessellate, UsualShapesHaveAsManyStepsAsAreAskedFor) {
  for (const ShapeType& type : shapeTypes()) {
    if (type.keyword == Mesh::kKeyword) continue;
    int followed = 0;
    tessellate(typical(type), 12, kFarthest, &followed);
    EXPECT_EQ(followed, 12) << type.keyword;
  }
}

TEST(Tessellate, ACubeHasSharpEdges) {
  const auto corners = tessellate(Cube{}, 8);
  int atCorners = 0;
  for (const SurfaceCorner& corner : corners) {
    int flush = 0, straight = 0;
    for (int axis = 0; axis < 3; ++axis) {
      flush += std::abs(std::abs(corner.point[axis]) - 0.5) < 1e-3;
      straight += std::abs(std::abs(corner.normal[axis]) - 1) < 1e-6;
    }
    EXPECT_GE(flush, 1);
    EXPECT_EQ(straight, 1);
    atCorners += flush == 3;
  }
  EXPECT_GE(atCorners, 24);
}

TEST(Tessellate, MeshesAreTheirOwnTriangles) {
  MeshData data;
  data.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}};
  data.triangles = {{0, 1, 2}, {0, 0, 1}};  // the second has no area
  const auto corners = tessellate(Mesh{std::make_shared<const MeshData>(data)});
  ASSERT_EQ(corners.size(), 3u);
  EXPECT_EQ(corners[1].point, (Vec3{1, 0, 0}));
  EXPECT_EQ(corners[1].normal, (Vec3{0, 0, 1}));
}

}  // namespace
}  // namespace trace::test
