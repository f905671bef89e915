// Meshes in place of shapes: closed, outward, and as near as their steps allow.
#include "geometry/mesh/tessellation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "geometry/mesh/tessellate.h"
#include "geometry/shapes/solids/blend.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "geometry/shapes/solids/superellipsoid.h"
#include "geometry/shapes/solids/torus.h"
#include "geometry/shapes/surfaces/lathe.h"
#include "geometry/shapes/surfaces/metaballs.h"
#include "geometry/shapes/surfaces/prism.h"
#include "geometry/shapes/surfaces/sphere_sweep.h"
#include "geometry/traced.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

TEST(Tessellation, EnclosesTheVolumeOfTheSolid) {
  EXPECT_NEAR(volumeOf(*tessellated(Sphere{}, 256)), 4.18879, 2e-3);
  EXPECT_NEAR(volumeOf(*tessellated(Cube{})), 1, 1e-7);
  EXPECT_NEAR(volumeOf(*tessellated(Cylinder{}, 256)), kPi, 1e-3);
  EXPECT_NEAR(volumeOf(*tessellated(Cone{}, 256)), kPi / 3, 1e-3);
  EXPECT_NEAR(volumeOf(*tessellated(Torus{})), 2 * kPi * kPi / 16, 0.02) << "out of crossings";
  EXPECT_NEAR(volumeOf(*tessellated(Conic{.bottomRadius = 1, .topRadius = 1, .zMin = 3, .zMax = 1}, 256)),
              2 * kPi, 2e-3);
}

TEST(Tessellation, PointsAndNormalsAreThoseOfTheSurface) {
  for (const Shape& shape :
       {Shape(Sphere{}), Shape(Cube{}), Shape(Square{}), Shape(Cylinder{}), Shape(Cone{}), Shape(Conic{})}) {
    const auto mesh = tessellated(shape);
    ASSERT_TRUE(mesh);
    SCOPED_TRACE(nameOf(shape));
    const TracedShape traced = prepare(shape);
    EXPECT_EQ(mesh->twoSided, !isSolid(traced));
    for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
      const Vec3 n = normalize(faceNormal(*mesh, i));
      for (std::uint32_t p : mesh->triangles[i]) {
        EXPECT_NEAR(length(Vec3(mesh->normals[p])), 1, 1e-6);
        EXPECT_GT(dot(n, Vec3(mesh->normals[p])), 0.9);
        // A ray along the normal meets the surface there.
        const Ray ray{Vec3(mesh->points[p]) * (1 - 1e-6) + Vec3(mesh->normals[p]), -Vec3(mesh->normals[p])};
        bool met = false;
        for (const Crossing& c : placesOf(traced, ray)) met |= std::abs(c.t - 1) < 1e-4;
        EXPECT_TRUE(met || std::hypot(mesh->points[p].x, mesh->points[p].y) > 0.24)
            << "at a rim the ray may pass by";
      }
    }
  }
}

/// How many edges of neighbouring triangles run the same way in both.
int turnedEdges(const std::vector<SurfaceCorner>& corners) {
  std::map<std::array<Real, 6>, int> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i].point, &b = corners[i % 3 == 2 ? i - 2 : i + 1].point;
    if (!(a == b)) ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
  }
  int turned = 0;
  for (const auto& [edge, times] : edges) {
    const auto back = edges.find({edge[3], edge[4], edge[5], edge[0], edge[1], edge[2]});
    turned += std::max(0, times - (back == edges.end() ? 0 : back->second));
  }
  return turned;
}

TEST(Tessellation, TrianglesOfASolidAreTurnedAlike) {
  // Where balls run into one another, the points of cells fold thin triangles over.
  const auto ball = [](const Vec3& middle, const Vec3& size) {
    return Operand{"", Sphere{}, Affine::translation(middle) * Affine::scaling(size), 0};
  };
  Blend balls;
  balls.radius = 0.5;
  balls.objects = Operands(
      {ball({}, {2, 1.8, 1.6}), ball({1.4, 0, 0}, {1.25, 1.5, 1.2}), ball({2.4, 1, 0}, {0.4, 1.6, 0.3})});
  EXPECT_EQ(turnedEdges(tessellate(balls, 64)), 0);
}

TEST(Tessellation, PicturesLieOnTheMeshAsOnTheShape) {
  for (const Shape& shape :
       {Shape(Sphere{}), Shape(Cube{}), Shape(Cylinder{}), Shape(Cone{}), Shape(Torus{})}) {
    SCOPED_TRACE(nameOf(shape));
    const auto mesh = tessellated(shape, 64, true);
    ASSERT_TRUE(mesh);
    ASSERT_EQ(mesh->uvs.size(), mesh->points.size());
    EXPECT_EQ(mesh->triangles.size(), tessellated(shape)->triangles.size());
    const TracedShape traced = prepare(shape);
    int asked = 0;
    for (std::uint32_t i = 0; i < mesh->triangles.size(); ++i) {
      Vec3 middle, normal = normalize(faceNormal(*mesh, i));
      Vec2 uv;
      for (std::uint32_t p : mesh->triangles[i]) {
        middle += Vec3(mesh->points[p]) / 3;
        uv = {uv.x + mesh->uvs[p].x / 3, uv.y + mesh->uvs[p].y / 3};
      }
      const Ray ray{middle + normal * 0.01, -normal};
      for (const Crossing& crossing : placesOf(traced, ray)) {
        if (std::abs(crossing.t - 0.01) > 0.01) continue;
        const Vec2 own = traced.surface(ray, crossing).uv;
        EXPECT_NEAR(std::remainder(own.x - uv.x, 1), 0, 0.03);
        EXPECT_NEAR(std::remainder(own.y - uv.y, 1), 0, 0.03);
        ++asked;
        break;
      }
    }
    EXPECT_GT(asked, static_cast<int>(mesh->triangles.size() / 2));
  }
  EXPECT_TRUE(tessellated(Sphere{})->uvs.empty()) << "for which nobody has asked";
}

TEST(Tessellation, SolidsFaceOutward) {
  for (const Shape& shape : {Shape(Torus{}), Shape(RoundedBox{}), Shape(Ellipsoid{}), Shape(Superellipsoid{}),
                             Shape(Lathe{}), Shape(Prism{}), Shape(SphereSweep{}), Shape(Metaballs{})}) {
    SCOPED_TRACE(nameOf(shape));
    const double exact = volume(shape, boundsOf(prepare(shape)), 60);
    EXPECT_NEAR(volumeOf(*tessellated(shape)), exact, 0.05 * exact);
  }
}

TEST(Tessellation, AllShapesWithAnEndBecomeTriangles) {
  for (const Shape& shape : analyticShapes()) {
    SCOPED_TRACE(nameOf(shape));
    const TracedShape traced = prepare(shape);
    const auto mesh = tessellated(shape, 8);
    EXPECT_EQ(mesh.has_value(), isFinite(boundsOf(traced).size()));
  }
}

TEST(Tessellation, LeavesOutWhatHasNoEnd) { EXPECT_FALSE(tessellated(Plane{})); }

}  // namespace
}  // namespace trace::test
