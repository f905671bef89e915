// The second texture coordinates of a mesh: at a place, their footprint and their slopes.
#include <gtest/gtest.h>

#include <memory>

#include "geometry/mesh/mesh.h"
#include "render/rays/tracer.h"
#include "render/world/world.h"
#include "shading/textures/image_map.h"
#include "support/seen.h"

namespace trace::second_uv_test {
namespace {

using test::Seen;

/// A triangle in the plane of x and y that is twice as large in the world. Its first coordinates are x and y,
/// the second 3 y and 1 - x.
Seen triangle(std::vector<Vec2> second, std::vector<FieldTexture> textures = {}) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.secondUvs = std::move(second);
  Scene scene;
  Material material;
  material.textures = std::move(textures);
  material.bump = 1;
  scene.materials = {material};
  Object object;
  object.shape = Mesh{std::make_shared<const MeshData>(std::move(mesh))};
  object.worldFromObject = Affine::scaling({2, 2, 2});
  scene.objects = {std::move(object)};
  return Seen(std::move(scene));
}
const std::vector<Vec2> kSecond{{0, 1}, {0, 0}, {3, 1}};

TEST(SecondUv, LieWhereTheMeshSays) {
  ImageMap map;
  map.filter = TexelFilter::trilinear;
  TextureNode node{.model = map};
  const Seen seen = triangle(kSecond, {{"diffuse", Texture(node)}});
  const Hit hit = seen.hit({0.5, 1, 5}, {0, 0, -1});
  Differentials arrived;
  arrived.originX = {0.2, 0, 0};
  arrived.originY = {0, 0.4, 0};
  const TexturePlace place = seen.world.place(hit, &arrived);
  const auto expectNear = [](const Vec2& a, const Vec2& b) {
    EXPECT_NEAR(a.x, b.x, 1e-12);
    EXPECT_NEAR(a.y, b.y, 1e-12);
  };
  expectNear(place.uv, {0.25, 0.5});
  expectNear(place.secondUv, {1.5, 0.75});
  expectNear(place.uvX, {0.1, 0});
  expectNear(place.secondUvX, {0, -0.1});
  expectNear(place.secondUvY, {0.6, 0});
  const SurfaceSlopes slopes = seen.world.secondSlopes(hit);
  EXPECT_NEAR(length(slopes.u - Vec3{0, 1.5, 0}), 0, 1e-12);
  EXPECT_NEAR(length(slopes.v - Vec3{-0.5, 0, 0}), 0, 1e-12);
}

TEST(SecondUv, AreTheFirstWhereThereAreNoOthers) {
  const Seen seen = triangle({});
  const TexturePlace place = seen.world.place(seen.hit({0.5, 1, 5}, {0, 0, -1}));
  EXPECT_EQ(place.secondUv, place.uv);
}

/// The normals of a picture turn with the coordinates by which it lies.
TEST(SecondUv, TurnPicturesOfNormals) {
  Picture picture(1, 1);
  picture.pixels[0] = {1, 0.5, 0.5};  // along u
  for (const bool second : {false, true}) {
    ImageMap map;
    map.relief = Relief::normals;
    map.secondUv = second;
    map.file.map = std::make_shared<const MipMap>(picture);
    TextureNode node{.model = map};
    const Seen seen = triangle(kSecond, {{"bump", Texture(node)}});
    const Vec3 normal = seen.hit({0.5, 1, 5}, {0, 0, -1}).surface.shading;
    EXPECT_GT(dot(normal, second ? Vec3{0, 1, 0} : Vec3{1, 0, 0}), 0.7) << second;
  }
}

}  // namespace
}  // namespace trace::second_uv_test
