// Crease normals, subdivision, polygons: against what is known exactly.
#include "geometry/mesh_smooth.h"

#include <gtest/gtest.h>

#include "geometry/mesh_repair.h"
#include "support/shapes.h"

namespace trace {
namespace {

MeshData cube() {
  MeshData mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& quad : quads) appendPolygon(mesh, quad);
  return mesh;
}

TEST(MeshSmooth, CreasesOfACube) {
  const MeshData sharp = withCreaseNormals(cube(), 0.5);
  EXPECT_EQ(sharp.points.size(), 24u) << "three at each corner";
  EXPECT_EQ(sharp.triangles.size(), 12u);
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t point : sharp.triangles[i])
      EXPECT_EQ(sharp.normals[point], Vec3f(normalize(faceNormal(sharp, i))));

  const MeshData smooth = withCreaseNormals(cube(), 2);
  EXPECT_EQ(smooth.points.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)  // by angles, however the squares are cut
    EXPECT_LT(length(Vec3(smooth.normals[i]) - normalize(Vec3(smooth.points[i]))), 1e-6);
}

TEST(MeshSmooth, JoinsPointsAtOnePlace) {
  MeshData mesh;  // two halves of a square, with points of their own
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, -0.0f}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {5, 0}, {5, 1}, {5, 2}};
  const MeshData smooth = withCreaseNormals(mesh, 1);
  EXPECT_EQ(smooth.points.size(), 6u) << "they differ in uv";
  EXPECT_EQ(smooth.uvs, mesh.uvs);
  EXPECT_EQ(smooth.normals, std::vector<Vec3f>(6, {0, 0, 1}));
}

TEST(MeshSmooth, SubdivisionOfAClosedMesh) {
  const MeshData once = subdivided(cube(), 1), thrice = subdivided(cube(), 3);
  EXPECT_EQ(once.points.size(), 8u + 18u);
  EXPECT_EQ(once.triangles.size(), 48u);
  EXPECT_EQ(thrice.triangles.size(), 12u * 64);
  EXPECT_LT(test::volumeOf(thrice), test::volumeOf(once));
  EXPECT_GT(test::volumeOf(thrice), 2);
  EXPECT_LT(test::volumeOf(thrice), 8);
}

TEST(MeshSmooth, SubdivisionKeepsAPlaneAndItsCorners) {
  MeshData mesh;
  mesh.points = {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MeshData fine = subdivided(mesh, 2);
  EXPECT_EQ(fine.triangles.size(), 32u);
  EXPECT_EQ(fine.uvs.size(), fine.points.size());
  for (std::uint32_t i = 0; i < fine.triangles.size(); ++i) EXPECT_GT(faceNormal(fine, i).z, 0);
  for (const Vec3f& p : fine.points) EXPECT_EQ(p.z, 2);
}

TEST(MeshRepair, PolygonsKeepTheirArea) {
  test::Random random(3);
  for (int corners = 3; corners < 40; ++corners) {
    MeshData star;  // seen from its middle, every corner is visible, so that it does not cross itself
    std::vector<std::uint32_t> polygon;
    double area = 0;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * kPi * i / corners, r = random.uniform(0.2, 1);
      star.points.push_back(Vec3f(Vec3{r * std::cos(angle), 3, -r * std::sin(angle)}));
      polygon.push_back(static_cast<std::uint32_t>(i));
    }
    for (int i = 0; i < corners; ++i) {
      const Vec3 a(star.points[static_cast<std::size_t>(i)]),
          b(star.points[static_cast<std::size_t>((i + 1) % corners)]);
      area += cross(a - Vec3{0, 3, 0}, b - Vec3{0, 3, 0}).y / 2;
    }
    appendPolygon(star, polygon);
    ASSERT_EQ(star.triangles.size(), static_cast<std::size_t>(corners - 2));
    double sum = 0;
    for (std::uint32_t i = 0; i < star.triangles.size(); ++i) {
      EXPECT_GE(faceNormal(star, i).y, -1e-6) << corners;
      sum += faceNormal(star, i).y / 2;
    }
    EXPECT_NEAR(sum, area, 1e-5) << corners;
  }
}

}  // namespace
}  // namespace trace
