// Meshes in place of shapes: closed, outward, and as near as their steps allow.
#include "geometry/mesh/tessellation.h"

#include <gtest/gtest.h>

#include "geometry/shapes/cone.h"
#include "geometry/shapes/conic.h"
#include "geometry/shapes/cube.h"
#include "geometry/shapes/lathe.h"
#include "geometry/shapes/metaballs.h"
#include "geometry/shapes/plane.h"
#include "geometry/shapes/prism.h"
#include "geometry/shapes/quadric.h"
#include "geometry/shapes/rounded_box.h"
#include "geometry/shapes/sphere.h"
#include "geometry/shapes/sphere_sweep.h"
#include "geometry/shapes/square.h"
#include "geometry/shapes/superellipsoid.h"
#include "geometry/shapes/torus.h"
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
