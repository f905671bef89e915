// Crease normals, subdivision, polygons: against what is known exactly.
#include "geometry/mesh_smooth.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(MeshSmooth, CatmullClarkOfACube) {
  // Known by hand: a corner becomes 5/9 of itself, the middle of an edge (0, 3/4, 3/4), that of a face stays.
  const MeshData once = subdividedByCatmullClark(cube(), 1);
  ASSERT_EQ(once.points.size(), 8u + 12 + 6);
  EXPECT_EQ(once.triangles.size(), 6u * 4 * 2);
  EXPECT_EQ(once.polygons.size(), 24u);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_LT(length(Vec3(once.points[i]) - Vec3(cube().points[i]) * (5.0 / 9)), 1e-6);
  for (std::size_t i = 8; i < 20; ++i) EXPECT_NEAR(length(Vec3(once.points[i])), 0.75 * std::sqrt(2.0), 1e-6);
  for (std::size_t i = 20; i < 26; ++i) EXPECT_NEAR(length(Vec3(once.points[i])), 1, 1e-6);
  // A closed surface that shrinks, and looks the same along all three axes, unlike Loop's of a cube cut into
  // triangles.
  const MeshData fine = subdividedByCatmullClark(cube(), 4);
  EXPECT_EQ(fine.triangles.size(), 6u * 256 * 2);
  EXPECT_LT(test::volumeOf(fine), test::volumeOf(once));
  const Box3 box = bounds(fine);
  EXPECT_NEAR(box.high.x, box.high.y, 1e-6);
  EXPECT_NEAR(box.high.x, box.high.z, 1e-6);
}

TEST(MeshSmooth, CatmullClarkTakesPolygonsAndTrianglesAndBorders) {
  MeshData mesh;  // a pentagon and a triangle in a plane
  mesh.points = {{0, 0, 2}, {2, 0, 2}, {3, 1, 2}, {1, 3, 2}, {-1, 1, 2}, {3, -1, 2}};
  mesh.uvs = {{0, 0}, {2, 0}, {3, 1}, {1, 3}, {-1, 1}, {3, -1}};
  appendPolygon(mesh, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4});
  appendPolygon(mesh, std::array<std::uint32_t, 3>{1, 5, 2});
  ASSERT_EQ(mesh.polygons.size(), 1u);
  const MeshData fine = subdividedByCatmullClark(mesh, 2);
  EXPECT_EQ(fine.polygons.size(), (5u + 3) * 4);
  EXPECT_EQ(fine.uvs.size(), fine.points.size());
  for (std::size_t i = 0; i < fine.points.size(); ++i) EXPECT_EQ(fine.points[i].z, 2);
  for (std::uint32_t i = 0; i < fine.triangles.size(); ++i) EXPECT_GT(faceNormal(fine, i).z, 0);
}

TEST(MeshSmooth, PolygonsSurviveWhatIsLeftOut) {
  MeshData mesh = cube();
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  for (auto& polygon : mesh.polygons) ++polygon[0];
  EXPECT_EQ(dropDegenerate(mesh), 1u);
  EXPECT_EQ(mesh.polygons, cube().polygons);
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
