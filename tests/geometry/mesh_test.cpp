#include "geometry/mesh/mesh.h"

#include <gtest/gtest.h>

#include <optional>

#include "support/shapes.h"

namespace trace::test {
namespace {

std::optional<TriangleHit> intersect(const MeshData& mesh, std::uint32_t index, const Ray& ray) {
  TriangleHit hit;
  if (!TriangleRay(ray).intersect(corners(mesh, index), kInfinity, hit)) return {};
  return hit;
}

/// Crossings of the whole mesh ahead of the ray.
int countCrossings(const MeshData& mesh, const Ray& ray) {
  int count = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    if (intersect(mesh, i, ray)) ++count;
  return count;
}

TEST(Mesh, WatertightAtEdgesAndVertices) {
  // From inside a closed mesh, aimed exactly at vertices, edge midpoints and points on edges: always an odd
  // number of crossings; past the mesh from outside: always an even one.
  Random random(1);
  const auto mesh = ballMesh(12, random);
  int escapes = 0, odd = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle& t =
        mesh->triangles[static_cast<size_t>(random.below(static_cast<int>(mesh->triangles.size())))];
    const Vec3 a(mesh->points[t[0]]), b(mesh->points[t[1]]);
    const Vec3 target = i % 3 == 0 ? a : i % 3 == 1 ? (a + b) * 0.5 : a + (b - a) * random.uniform();
    const Vec3 inside = i % 5 == 0 ? Vec3{} : random.inCube(0.3);
    if (countCrossings(*mesh, {inside, target - inside}) % 2 == 0) ++escapes;
    const Vec3 outside = random.direction() * 4;
    if (countCrossings(*mesh, {outside, target - outside}) % 2 == 1) ++odd;
  }
  EXPECT_EQ(escapes, 0);
  EXPECT_EQ(odd, 0);
}

TEST(Mesh, OneHitWhereAxisAlignedRaysMeetSharedEdges) {
  // A square of two triangles: every ray through the diagonal, the corners and the border is counted once at
  // most, and inside the square exactly once.
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int i = 1; i < 16; ++i) {
    const Ray ray{{i / 16.0, i / 16.0, 1}, {0, 0, -1}};
    EXPECT_EQ(countCrossings(mesh, ray), 1) << i;
  }
}

TEST(Mesh, BarycentricCoordinatesFindThePoint) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  const Ray ray{{0.5, 1, 3}, {0, 0, -1}};
  const auto hit = intersect(mesh, 0, ray);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 3);
  EXPECT_DOUBLE_EQ(hit->b[0], 0.25);
  EXPECT_DOUBLE_EQ(hit->b[1], 0.25);
  EXPECT_DOUBLE_EQ(hit->b[2], 0.5);
  EXPECT_TRUE(hit->front);
  EXPECT_EQ(surface(mesh, 0, *hit).point, (Vec3{0.5, 1, 0}));
  EXPECT_FALSE(intersect(mesh, 0, {{0.5, 1, -3}, {0, 0, 1}})->front);
}

TEST(Mesh, DegenerateTrianglesAreNeverHit) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 1}, {1, 1, 1}};
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 o = random.inCube(5);
    for (std::uint32_t k = 0; k < 3; ++k) EXPECT_FALSE(intersect(mesh, k, {o, Vec3{1, 1, 1} - o}));
  }
}

TEST(Mesh, InterpolatedNormalIsTheNormalisedMix) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  const auto hit = intersect(mesh, 0, {{0.25, 0.25, 1}, {0, 0, -1}});
  const SurfacePoint s = surface(mesh, 0, *hit);
  EXPECT_EQ(s.normal, (Vec3{0, 0, 1}));
  const Vec3 expected = normalize({0.25, 0.25, 0.5});
  EXPECT_NEAR(length(s.shading - expected), 0, 1e-15);
}

TEST(Mesh, GeneratedNormals) {
  // The corner of a cube: the mean of three unit face normals, whatever the faces' areas.
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {5, 0, 0}, {0, 1, 0}, {0, 0, 2}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}};
  const MeshData mean = withGeneratedNormals(mesh, false), unit = withGeneratedNormals(mesh, true);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(mean.normals[0][i], -1.0 / 3, 1e-7);
    EXPECT_NEAR(unit.normals[0][i], -1 / std::sqrt(3.0), 1e-7);
  }
}

}  // namespace
}  // namespace trace::test
