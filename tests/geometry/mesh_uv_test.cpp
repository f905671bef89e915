// Projected texture coordinates: those of the shapes they imitate, and no face that runs backwards.
#include "geometry/mesh/mesh_uv.h"

#include <gtest/gtest.h>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/sphere.h"
#include "support/shapes.h"

namespace trace {
namespace {

TEST(MeshUv, SphericalIsThatOfTheSphere) {
  test::Random random(9);
  MeshData ball = *test::ballMesh(12, random);
  for (Vec3f& p : ball.points) p = Vec3f(normalize(Vec3(p)));
  const MeshData mesh = withProjectedUvs(ball, UvProjection::spherical);
  EXPECT_EQ(mesh.triangles.size(), ball.triangles.size());
  EXPECT_GT(mesh.points.size(), ball.points.size()) << "doubled along the seam";
  ASSERT_EQ(mesh.uvs.size(), mesh.points.size());
  for (const Triangle& t : mesh.triangles)
    for (int c = 0; c < 3; ++c) {
      const Vec2 &a = mesh.uvs[t[static_cast<std::size_t>(c)]],
                 &b = mesh.uvs[t[static_cast<std::size_t>((c + 1) % 3)]];
      EXPECT_LT(std::abs(a.x - b.x), 0.1);
    }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3 p(mesh.points[i]);
    if (std::hypot(p.x, p.y) < 1e-3) continue;  // a pole
    const Ray ray{p * 3, -p};
    const auto found = test::crossingsOf(Sphere{}, ray);
    ASSERT_EQ(found.size(), 2u);
    const Vec2 uv = Sphere{}.surface(ray, found[0]).uv;
    EXPECT_NEAR(mesh.uvs[i].y, uv.y, 0.02);
    EXPECT_NEAR(mesh.uvs[i].x - std::floor(mesh.uvs[i].x), uv.x - std::floor(uv.x), 0.02);
  }
}

TEST(MeshUv, PlanarAndCubicFollowTheBox) {
  MeshData mesh;
  mesh.points = {{-1, 0, 5}, {3, 0, 5}, {3, 2, 5}, {-1, 2, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const MeshData planar = withProjectedUvs(mesh, UvProjection::planar);
  EXPECT_EQ(planar.points, mesh.points);
  EXPECT_EQ(planar.uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  const MeshData cubic = withProjectedUvs(mesh, UvProjection::cubic);
  EXPECT_EQ(cubic.uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}}))
      << "square pixels stay square";
  const MeshData round = withProjectedUvs(mesh, UvProjection::cylindrical);
  for (const Vec2& uv : round.uvs) EXPECT_EQ(uv.y, 0.5) << "a box without height";
}

TEST(MeshUv, NamesAreThoseOfTheFormat) {
  EXPECT_EQ(uvProjection("cubic"), UvProjection::cubic);
  EXPECT_FALSE(uvProjection("conical"));
}

}  // namespace
}  // namespace trace
