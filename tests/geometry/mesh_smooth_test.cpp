// Crease normals, subdivision, polygons: against what is known exactly.
#include "geometry/mesh/mesh_smooth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh/mesh.h"
#include "geometry/mesh/mesh_repair.h"
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

/// The edges of the cube, but for those the filter leaves out.
template <class Keep>
std::vector<Crease> edgesOfCube(Real sharpness, Keep&& keep) {
  std::vector<Crease> creases;
  for (std::uint32_t a = 0; a < 8; ++a)
    for (const std::uint32_t bit : {1u, 2u, 4u})
      if (!(a & bit) && keep(a, a | bit)) creases.push_back({a | bit, a, sharpness});
  return creases;
}
std::vector<Crease> allEdges(Real sharpness) {
  return edgesOfCube(sharpness, [](auto, auto) { return true; });
}
Real farthest(const MeshData& a, const MeshData& b) {
  Real most = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    most = max(most, length(Vec3(a.points[i]) - Vec3(b.points[i])));
  return most;
}

TEST(MeshSmooth, ACubeOfSharpEdgesKeepsItsPlanes) {
  for (const Real sharpness : {3.0, 10.0, kInfinity})
    for (const MeshData& fine : {subdividedByCatmullClark(cube(), 3, allEdges(sharpness)),
                                 subdivided(cube(), 3, allEdges(sharpness))}) {
      EXPECT_NEAR(test::volumeOf(fine), 8, 1e-6);
      for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(fine.points[i], cube().points[i]);
    }
}

TEST(MeshSmooth, AnInfinitelySharpEdgeIsABorder) {
  // With the edges around its top face for ever sharp, the cube without its lid is the open box.
  const auto top = [](std::uint32_t a, std::uint32_t b) { return (a & 4) && (b & 4); };
  MeshData open = cube();
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);  // the lid, z = 1
  open.polygons.clear();
  for (std::uint32_t i = 0; i < 5; ++i) open.polygons.push_back({2 * i, 2});
  const MeshData creased = subdividedByCatmullClark(cube(), 1, edgesOfCube(kInfinity, top));
  const MeshData border = subdividedByCatmullClark(open, 1);
  for (std::size_t i = 4; i < 8; ++i) EXPECT_EQ(creased.points[i], border.points[i]);
  // A corner of the rim is 3/4 of itself and 1/8 of each neighbour along it.
  EXPECT_EQ(creased.points[7], (Vec3f{0.75f, 0.75f, 1}));
}

TEST(MeshSmooth, BrokenSharpnessMixes) {
  // One level: half way between the smooth cube and the cube; two levels: as of 1, the last edge half sharp.
  for (const Real share : {0.25, 0.5, 0.75}) {
    const MeshData smooth = subdividedByCatmullClark(cube(), 1),
                   sharp = subdividedByCatmullClark(cube(), 1, allEdges(1));
    const MeshData mixed = subdividedByCatmullClark(cube(), 1, allEdges(share));
    for (std::size_t i = 0; i < mixed.points.size(); ++i) {
      const Vec3 p(smooth.points[i]), q(sharp.points[i]);
      EXPECT_LT(length(Vec3(mixed.points[i]) - (p + (q - p) * share)), 1e-6);
    }
  }
  const auto volume = [](Real sharpness) {
    return test::volumeOf(subdividedByCatmullClark(cube(), 3, allEdges(sharpness)));
  };
  for (Real s = 0; s < 3; s += 0.25) EXPECT_LT(volume(s), volume(s + 0.25));
  EXPECT_EQ(farthest(subdivided(cube(), 2, allEdges(0)), subdivided(cube(), 2)), 0);
}

TEST(MeshSmooth, OneSharpEdgeAloneEndsInSmoothPoints) {
  const auto one = [](std::uint32_t a, std::uint32_t b) { return a == 6 && b == 7; };
  const MeshData smooth = subdividedByCatmullClark(cube(), 1);
  const MeshData dart = subdividedByCatmullClark(cube(), 1, edgesOfCube(2, one));
  int moved = 0;
  for (std::size_t i = 0; i < smooth.points.size(); ++i)
    if (!(smooth.points[i] == dart.points[i])) {
      ++moved;
      EXPECT_EQ(dart.points[i], (Vec3f{0, 1, 1})) << "the middle of the edge";
    }
  EXPECT_EQ(moved, 1);
}

TEST(MeshSmooth, PolygonsSurviveWhatIsLeftOut) {
  MeshData mesh = cube();
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  for (auto& polygon : mesh.polygons) ++polygon[0];
  EXPECT_EQ(dropDegenerate(mesh).count, 1u);
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
