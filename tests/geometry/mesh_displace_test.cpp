// Displaced meshes against formulas: heights, radii, and that nothing opens.
#include "geometry/mesh/mesh_displace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/error.h"
#include "geometry/mesh/mesh_closed.h"
#include "geometry/mesh/mesh_smooth.h"
#include "support/ball.h"
#include "support/shapes.h"

namespace trace::test {
namespace {

HeightOfPoint constant(Real height) {
  return [=](const MeshData&, std::uint32_t) { return height; };
}

/// A square of two triangles, with uv, facing z.
MeshData square() {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return mesh;
}

TEST(MeshDisplace, ASquareHasTheHeightsOfTheFormula) {
  const auto wave = [](Real u, Real v) { return 0.1 * std::sin(5 * u) * std::cos(3 * v); };
  const MeshData made = displaced(
      square(), 6, [&](const MeshData& mesh, std::uint32_t i) { return wave(mesh.uvs[i].x, mesh.uvs[i].y); });
  EXPECT_EQ(made.triangles.size(), 2u * 4096);
  EXPECT_EQ(made.points.size(), 65u * 65) << "shared edges stay shared";
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    const Vec3 p(made.points[i]);
    EXPECT_NEAR(p.z, wave(p.x, p.y), 1e-6);
    EXPECT_NEAR(p.x, made.uvs[i].x, 1e-6);
    if (p.x < 0.05 || p.x > 0.95 || p.y < 0.05 || p.y > 0.95) continue;
    const Vec3 slope{-0.5 * std::cos(5 * p.x) * std::cos(3 * p.y),
                     0.3 * std::sin(5 * p.x) * std::sin(3 * p.y), 1};
    EXPECT_LT(length(Vec3(made.normals[i]) - normalize(slope)), 2e-3) << "made anew";
  }
}

TEST(MeshDisplace, ASphereMovedByAConstantHasThatRadiusMore) {
  const MeshData made = displaced(*sphereMesh(24, 12, 2), 0, constant(0.25));
  for (const Vec3f& p : made.points) EXPECT_NEAR(length(Vec3(p)), 2.25, 1e-6);
  for (std::size_t i = 0; i < made.points.size(); ++i)
    EXPECT_GT(dot(Vec3(made.normals[i]), normalize(Vec3(made.points[i]))), 0.999);
}

TEST(MeshDisplace, ClosedStaysClosed) {
  Random random(3);
  const MeshData corners = *ballMesh(4, random);  // of triangles with points of their own
  MeshData apart;
  for (const Triangle& t : corners.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.points.size());
    for (const std::uint32_t point : t) apart.points.push_back(corners.points[point]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  for (std::size_t i = 0; i < apart.points.size(); ++i)  // no corner agrees with another in uv
    apart.uvs.push_back({random.uniform(), random.uniform()});
  const MeshData sharp = withCreaseNormals(corners, 0.1);
  for (const MeshData* mesh : {&corners, &std::as_const(apart), &sharp}) {
    ASSERT_TRUE(closed(*mesh));
    const MeshData made = displaced(*mesh, 3, [&](const MeshData& cut, std::uint32_t i) {
      const Vec2 uv = cut.uvs.empty() ? Vec2{} : cut.uvs[i];
      return 0.1 * std::sin(9 * cut.points[i].x + 5 * uv.x) + 0.05 * uv.y;
    });
    EXPECT_EQ(made.triangles.size(), 64 * mesh->triangles.size());
    EXPECT_TRUE(closed(made));
    EXPECT_GT(volumeOf(made), 1);
  }
}

TEST(MeshDisplace, SharpEdgesStaySharpAndSmoothOnesSmooth) {
  MeshData roof;  // two squares that meet at a right angle along y
  roof.points = {{-1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {-1, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  roof.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  const auto atRidge = [](const MeshData& mesh) {
    std::size_t differ = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      if (std::abs(mesh.points[i].x) < 1e-6) differ += std::abs(mesh.normals[i].x) > 0.5;
    return differ;
  };
  EXPECT_EQ(atRidge(displaced(roof, 2, constant(0.1))), 0u) << "without normals it becomes smooth";
  EXPECT_EQ(atRidge(displaced(withCreaseNormals(roof, 0.5), 2, constant(0.1))), 10u);
}

TEST(MeshDisplace, KeepsWhatPointsHave) {
  MeshData mesh = square();
  mesh.materials = {1, 1, 2, 2};
  mesh.twoSided = true;
  const MeshData made = displaced(mesh, 2, constant(0.5));
  EXPECT_EQ(made.materials.size(), made.points.size());
  EXPECT_TRUE(made.twoSided);
  EXPECT_FALSE(made.generateNormals);
  for (const Vec3f& p : made.points) EXPECT_EQ(p.z, 0.5f);
}

TEST(MeshDisplace, PointsStayWhereNormalsCancel) {
  MeshData mesh = square();  // both sides of one sheet
  mesh.normals.assign(4, {0, 0, 1});
  for (int i = 0; i < 4; ++i) {
    mesh.points.push_back(mesh.points[static_cast<std::size_t>(i)]);
    mesh.uvs.push_back({0, 0});
    mesh.normals.push_back({0, 0, -1});
  }
  mesh.triangles.push_back({4, 6, 5});
  mesh.triangles.push_back({4, 7, 6});
  EXPECT_EQ(displaced(mesh, 0, constant(0.5)).points, mesh.points);
}

TEST(MeshDisplace, RefusesWhatNoFloatHolds) { EXPECT_THROW(displaced(square(), 1, constant(1e300)), Error); }

}  // namespace
}  // namespace trace::test
