// Normals bent by the heights of a texture, against those of surfaces whose shape is known.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "render/rays/tracer.h"
#include "render/world/world.h"
#include "shading/materials/principled.h"
#include "shading/textures/formula.h"
#include "shading/textures/image_map.h"
#include "support/seen.h"

namespace trace::bump_test {
namespace {

using test::Seen;

Material bumped(std::string formula, Real height) {
  Formula heights;
  heights.value = FormulaText(std::move(formula));
  heights.ramp = {{-1000, -1000, -1000, -1000}, {1000, 1000, 1000, 1000}};  // the number itself
  Material material;
  material.textures = {{"bump", Texture(TextureNode{.model = heights})}};
  material.bump = height;
  return material;
}

Seen seen(Shape shape, const Affine& worldFromObject, Material material) {
  Scene scene;
  scene.materials = {std::move(material)};
  Object object;
  object.shape = std::move(shape);
  object.worldFromObject = worldFromObject;
  scene.objects = {std::move(object)};
  return Seen(std::move(scene));
}

void expectNear(const Vec3& a, const Vec3& b, Real tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Bump, IsTheNormalOfTheSurfaceWithTheHeightsOnIt) {
  const Seen plane = seen(Plane{}, {}, bumped("sin(3*x) + 0.5*y", 0.1));
  for (const Real x : {-1.0, 0.0, 0.3, 2.0}) {
    const SurfacePoint p = plane.at({x, 0.2, 5}, {0, 0, -1});
    expectNear(p.shading, normalize(Vec3{-0.3 * std::cos(3 * x), -0.05, 1}), 1e-3);
    EXPECT_EQ(p.normal, (Vec3{0, 0, 1}));
  }
}

// The heights are in the object's space: a plane stretched along x has gentler slopes there, as its shape
// would.
TEST(Bump, GrowsWithItsObject) {
  const Seen plane = seen(Plane{}, Affine::scaling({4, 1, 2}), bumped("x + y", 0.25));
  expectNear(plane.at({1, 1, 5}, {0, 0, -1}).shading, normalize(Vec3{-0.25 * 2 / 4, -0.25 * 2, 1}), 1e-6);
}

// cos of the angle to z, as a height on a sphere: its gradient is z less its part along the normal.
TEST(Bump, FollowsCurvedSurfaces) {
  const Seen ball = seen(Sphere{}, {}, bumped("z", 0.2));
  const SurfacePoint p = ball.at({3, 0.3, 0.4}, {-1, 0, 0});
  const Vec3 gradient = Vec3{0, 0, 1} - p.normal * p.normal.z;
  expectNear(p.shading, normalize(p.normal - gradient * 0.2), 2e-3);
}

// A sphere's v goes from 0 to 1 from pole to pole.
TEST(Bump, KnowsTextureCoordinates) {
  const Seen ball = seen(Sphere{}, {}, bumped("v", 0.2));
  const SurfacePoint p = ball.at({3, 0.3, 0.4}, {-1, 0, 0});
  const Vec3 up = normalize(Vec3{0, 0, 1} - p.normal * p.normal.z);
  const Vec3 bent = normalize(p.normal - up * (0.2 / kPi)), other = normalize(p.normal + up * (0.2 / kPi));
  EXPECT_LT(min(length(p.shading - bent), length(p.shading - other)), 2e-3);  // whichever pole is 0
}

TEST(Bump, LeavesTheNormalWhereTheHeightIsLevel) {
  const Seen ball = seen(Sphere{}, Affine::scaling({1, 2, 3}), bumped("7", 1));
  const SurfacePoint p = ball.at({3, 0.3, 0.4}, {-1, 0, 0});
  EXPECT_EQ(p.shading, p.normal);
}

// However steep, a ray that is mirrored stays outside, and the eye sees the front.
TEST(Bump, NeverMirrorsIntoTheSurface) {
  const Seen plane = seen(Plane{}, {}, bumped("sin(40*x) + sin(37*y)", 3));
  for (int i = 0; i < 200; ++i) {
    const Vec3 direction = normalize(Vec3{1, 0.01 * i, -0.05 - 0.003 * i});
    const SurfacePoint p = plane.at({0.013 * i, 0.2, 1}, direction);
    EXPECT_NEAR(length(p.shading), 1, 1e-12);
    EXPECT_LT(dot(direction, p.shading), 0);
    EXPECT_GT((direction - p.shading * (2 * dot(direction, p.shading))).z, 0);
  }
}

// --- pictures of normals -----------------------------------------------------------------------------------

Material withNormals(const Color& texel, Relief relief, Real scale) {
  Picture picture(2, 2);
  for (Color& c : picture.pixels) c = texel;
  ImageMap map;
  map.file.map = std::make_shared<const MipMap>(picture);
  map.relief = relief;
  Material material;
  material.textures = {{"bump", Texture(TextureNode{.model = map})}};
  material.bump = scale;
  return material;
}

TEST(Bump, APictureOfNormalsSaysThemAlongUAndV) {
  const auto normal = [](const Color& texel, Relief relief, Real scale) {
    return seen(Plane{}, {}, withNormals(texel, relief, scale)).at({0.3, 0.4, 5}, {0, 0, -1}).shading;
  };
  expectNear(normal({0.5, 0.5, 1}, Relief::normals, 1), {0, 0, 1}, 1e-6);
  expectNear(normal({0.625, 0.5, 1}, Relief::normals, 1), normalize({0.25, 0, 1}), 1e-6);
  expectNear(normal({0.625, 0.5, 1}, Relief::normals, 0.5), normalize({0.125, 0, 1}), 1e-6);
  expectNear(normal({0.5, 0.625, 1}, Relief::normals, 1), normalize({0, 0.25, 1}), 1e-6);
  expectNear(normal({0.5, 0.625, 1}, Relief::normalsDown, 1), normalize({0, -0.25, 1}), 1e-6);
  expectNear(normal({0.625, 0.625, 1}, Relief::heights, 1), {0, 0, 1}, 1e-6);
}

/// A square in the plane z = 0 whose u lies along x and v along y, with these tangents.
Shape squareWith(const MeshTangent& tangent) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.tangents.assign(4, tangent);
  return Mesh{std::make_shared<const MeshData>(mesh)};
}

TEST(Bump, TangentsOfAMeshSayHowAPictureOfNormalsLies) {
  const auto normal = [](const MeshTangent& tangent, const Affine& at, Real from = 5) {
    const Material material = withNormals({0.625, 0.75, 1}, Relief::normals, 1);
    return seen(squareWith(tangent), at, material)
        .at({0.3, 0.4, from}, {0, 0, from > 0 ? -1.0 : 1.0})
        .shading;
  };
  expectNear(normal({{1, 0, 0}, 1}, {}), normalize({0.25, 0.5, 1}), 1e-6);
  expectNear(normal({{1, 0, 0}, -1}, {}), normalize({0.25, -0.5, 1}), 1e-6);
  expectNear(normal({{0, 2, 0}, 1}, {}), normalize({-0.5, 0.25, 1}), 1e-6);
  expectNear(normal({{0, 0, 0}, 1}, {}), normalize({0.25, 0.5, 1}), 1e-6);  // as the texture coordinates say
  // Mirrored, the square shows its other side; the texture keeps its place on it.
  const Affine mirror = Affine::translation({1, 0, 0}) * Affine::scaling({-1, 1, 1});
  const Vec3 mirrored = normal({{1, 0, 0}, 1}, mirror);
  EXPECT_NEAR(mirrored.x, -normalize({0.25, 0.5, 1}).x, 1e-6);
  EXPECT_NEAR(mirrored.y, normalize({0.25, 0.5, 1}).y, 1e-6);
}

TEST(Bump, PicturesOfNormalsTurnWithTheObject) {
  const Affine turned = Affine::rotation({0, 0, 1}, kPi / 2);
  const Seen plane = seen(Plane{}, turned, withNormals({0.625, 0.5, 1}, Relief::normals, 1));
  expectNear(plane.at({0.3, 0.4, 5}, {0, 0, -1}).shading, normalize({0, 0.25, 1}), 1e-6);
}

TEST(Bump, AClearCoatMayBeBentApart) {
  const auto hit = [](bool apart, bool coated) {
    Material material = withNormals({0.625, 0.5, 1}, Relief::normals, 1);
    Principled model;
    model.clearcoat = 1;
    model.clearcoatApart = apart;
    model.clearcoatBump = 0.5;
    material.model = model;
    const Material coat = withNormals({0.5, 0.625, 1}, Relief::normals, 1);
    if (coated) setTexture(material.textures, "clearcoat_bump", coat.textures[0].texture);
    return seen(Plane{}, {}, material).hit({0.3, 0.4, 5}, {0, 0, -1});
  };
  for (const bool apart : {false, true})
    expectNear(hit(apart, true).surface.shading, normalize({0.25, 0, 1}), 1e-6);
  EXPECT_EQ(hit(false, true).coat, Vec3{}) << "it is bent as the surface is";
  expectNear(hit(true, true).coat, normalize({0, 0.125, 1}), 1e-6);
  EXPECT_EQ(hit(true, false).coat, (Vec3{0, 0, 1})) << "smooth";
}

}  // namespace
}  // namespace trace::bump_test
