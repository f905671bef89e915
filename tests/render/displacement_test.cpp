// Displacement of meshes by their materials, as the World has it.
#include "scene/displacement.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/sphere.h"
#include "shading/lights/point_light.h"
#include "shading/textures/formula.h"
#include "shading/textures/noise.h"
#include "support/ball.h"
#include "support/scenes.h"

namespace trace::test::displacement_test {
namespace {

Texture formula(std::string text) {
  Formula heights;
  heights.value = FormulaText(std::move(text));
  heights.ramp = {{-1000, -1000, -1000, -1000}, {1000, 1000, 1000, 1000}};  // the number itself
  return TextureNode{.model = heights};
}

Scene displacedBall(Real height, int levels, std::optional<Texture> texture = {}) {
  Scene scene;
  Phong white;
  white.diffuse = Color(1);
  addObject(scene, Mesh{sphereMesh(8, 4)}, Affine::translation({1, 2, 3}), white);
  scene.materials[0].displacement = height;
  scene.materials[0].displacementLevels = levels;
  if (texture) setTexture(scene.materials[0].textures, "displacement", *texture);
  scene.lights.push_back({PointLight{.position = {9, 9, 9}, .color = Color(1)}, {}});
  scene.camera.position = {1, 2, 8};
  return scene;
}

std::size_t warnings(const Scene& scene) {
  Messages messages;
  compile(scene, {.width = 8}, messages);
  return messages.all().size();
}

TEST(Displacement, MovesPointsByTheTextureInTheSpaceOfTheObject) {
  const World world = build(displacedBall(0.5, 0, formula("z")));
  const MeshData& made = world.meshTree(0)->data();
  const MeshData given = *sphereMesh(8, 4);
  ASSERT_EQ(made.points.size(), given.points.size());
  for (std::size_t i = 0; i < made.points.size(); ++i)
    EXPECT_NEAR(length(Vec3(made.points[i])), 1 + 0.5 * given.points[i].z, 1e-6);
  EXPECT_NEAR(world.boundsOf(0).high.z, 3 + 1.5, 1e-5);
}

TEST(Displacement, IsOfTheFinestLevelOfItsMaterials) {
  EXPECT_EQ(build(displacedBall(0.5, 3)).triangleCount(), sphereMesh(8, 4)->triangles.size() * 64);
  EXPECT_EQ(build(displacedBall(0, 3)).triangleCount(), sphereMesh(8, 4)->triangles.size())
      << "nothing moves";
}

TEST(Displacement, WithoutTexturesTheMeshIsAsItWas) {
  const Scene displaced = displacedBall(0.5, 2, formula("z"));
  const Picture plain = picture(displacedBall(0, 0), {.width = 40});
  EXPECT_EQ(picture(displaced, {.width = 40, .textures = false}), plain);
  EXPECT_NE(picture(displaced, {.width = 40}), plain);
}

TEST(Displacement, AfterAnEditOnlyWhatIsDisplacedOtherwiseIsMadeAnew) {
  Scene scene = displacedBall(0.1, 2, formula("x"));
  addObject(scene, scene.objects[0].shape, {}, {});
  scene.objects.push_back(scene.objects[0]);
  const Settings settings{.width = 30};
  const World world = build(scene, settings);
  EXPECT_EQ(world.meshTree(0), world.meshTree(2)) << "the same mesh and material";
  EXPECT_NE(world.meshTree(0), world.meshTree(1));
  const auto edited = [&](auto&& edit) {
    Scene other = scene;
    edit(other);
    Messages messages;
    const Compiled before{scene, settings, world};
    World now = compile(other, settings, messages, &before);
    EXPECT_EQ(picture(now, settings, other.camera), picture(other, settings));
    return now;
  };
  const World painted = edited([](Scene& s) { s.materials[0].model.edit<Phong>()->diffuse = {1, 0, 0}; });
  EXPECT_EQ(painted.meshTree(0), world.meshTree(0));
  const World higher = edited([](Scene& s) { s.materials[0].displacement = 0.2; });
  EXPECT_NE(higher.meshTree(0), world.meshTree(0));
  EXPECT_EQ(higher.meshTree(1), world.meshTree(1));
  const World other =
      edited([](Scene& s) { setTexture(s.materials[0].textures, "displacement", formula("y")); });
  EXPECT_NE(other.meshTree(0), world.meshTree(0));
  const World plain = edited([](Scene& s) { s.objects[0].material = s.objects[1].material; });
  EXPECT_EQ(plain.meshTree(0), world.meshTree(1));
}

TEST(Displacement, PointsOfSeveralMaterialsMoveByTheirOwn) {
  Scene scene = displacedBall(0.5, 0);
  addMaterial(scene, {});
  MeshData mesh = *sphereMesh(8, 4);
  for (const Vec3f& p : mesh.points) mesh.materials.push_back(p.z > 0.5f ? 0 : 1);
  scene.objects[0].shape = Mesh{std::make_shared<const MeshData>(mesh)};
  const World world = build(scene);
  const MeshData& made = world.meshTree(0)->data();
  for (std::size_t i = 0; i < made.points.size(); ++i)
    EXPECT_NEAR(length(Vec3(made.points[i])), mesh.points[i].z > 0.5f ? 1.5 : 1, 1e-6);
}

TEST(Displacement, WarnsOfWhatItCannotMove) {
  EXPECT_EQ(warnings(displacedBall(0.5, 1, formula("z"))), 0u);
  Noise noise;
  noise.space = TextureSpace::uv;
  const Texture flat = TextureNode{.model = noise};
  EXPECT_EQ(warnings(displacedBall(0.5, 1, flat)), 1u) << "the mesh has no uv";
  Scene scene = displacedBall(0.5, 1);
  scene.objects[0].shape = Sphere{};
  scene.objects.push_back(scene.objects[0]);
  EXPECT_EQ(warnings(scene), 1u) << "one for all";
}

TEST(Displacement, CountsTrianglesBeforeItMakesThem) {
  Scene scene = displacedBall(0.5, 10);
  MeshData mesh = *sphereMesh(8, 4);
  EXPECT_EQ(mesh.triangles.size(), 48u);
  for (const int levels : {10, 13, 40, 2'000'000'000}) {
    scene.materials[0].displacementLevels = levels;
    EXPECT_THROW(build(scene), Error) << "50.3 million at the least, of which 50 are allowed";
  }
}

}  // namespace
}  // namespace trace::test::displacement_test
