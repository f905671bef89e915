// Patterns that lie in the world: Material::patternSpace.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shapes/solids/cube.h"
#include "scene/groups.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/point_light.h"
#include "shading/textures/solid.h"
#include "support/scenes.h"

namespace trace::test::pattern_space_test {
namespace {

Affine at(Real x) { return Affine::translation({x, 0, 0}); }

/// Boxes of one material, seen from the front.
Scene wallOf(const std::vector<Affine>& boxes, PatternSpace space, Real bump = 0) {
  Phong phong;
  phong.ambient = Color(1);
  phong.diffuse = Color(bump > 0 ? 0.8 : 0);
  Material stone{.name = "", .model = phong, .patternSpace = space};
  stone.bump = bump;
  Solid pattern;
  pattern.kind = SolidPattern::granite;
  const Texture granite = TextureNode{.model = pattern};
  setTexture(stone.textures, "ambient", granite);
  if (bump > 0) setTexture(stone.textures, "bump", granite);
  Scene scene;
  scene.materials.push_back(stone);
  for (const Affine& box : boxes) scene.objects.push_back({"", Cube{}, box, 0, {}});
  scene.lights.push_back({AmbientLight{.color = Color(0.5)}, {}});
  if (bump > 0) scene.lights.push_back({PointLight{.position = {3, 2, 3}, .color = Color(1)}, {}});
  scene.camera.position = {0, 0, 4};
  scene.camera.fov = 30;
  return scene;
}

Picture pictureOf(const Scene& scene) {
  return picture(scene, {.width = 40, .spp = 1, .pixelPosition = PixelPosition::center, .threads = 1});
}

/// The fraction of pixels that differ by more than rounding.
Real different(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += std::abs(a.pixels[i].g - b.pixels[i].g) > 1e-6;
  return static_cast<Real>(count) / static_cast<Real>(a.pixels.size());
}

TEST(PatternSpace, BoxesShareOneBlockOfStone) {
  const std::vector<Affine> one{Affine::scaling({2, 1, 1})}, two{at(-0.5), at(0.5)};
  EXPECT_EQ(
      different(pictureOf(wallOf(one, PatternSpace::world)), pictureOf(wallOf(two, PatternSpace::world))), 0);
  EXPECT_GT(
      different(pictureOf(wallOf(one, PatternSpace::object)), pictureOf(wallOf(two, PatternSpace::object))),
      0.1);
}

// Also in the space of the object: bumps of placed objects were those of another object.
void expectPlacementsLikeCopies(PatternSpace space) {
  for (const Real bump : {0.0, 0.1}) {
    const Affine turned = Affine::rotation({0, 0, 1}, 0.2);
    Scene copies = wallOf({turned * at(-0.5), turned * at(0.5)}, space, bump);
    Scene placed = copies;
    placed.objects.clear();
    placed.groups.push_back({"box", {}, {{"", Cube{}, at(0.5), 0, {}}}, {}});
    auto list = std::make_shared<GroupUses::List>();
    for (const Real x : {-1.0, 0.0}) list->push_back({turned * at(x), 0});
    placed.usePlaces.push_back({});
    placed.uses.push_back({0, list});
    EXPECT_EQ(different(pictureOf(placed), pictureOf(copies)), 0) << bump;
  }
}

TEST(PatternSpace, PlacementsOfAGroupAreLikeCopies) {
  expectPlacementsLikeCopies(PatternSpace::world);
  expectPlacementsLikeCopies(PatternSpace::object);
}

}  // namespace
}  // namespace trace::test::pattern_space_test
