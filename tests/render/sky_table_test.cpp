// Directions by the brightness of what is around.
#include "render/lights/sky_table.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "support/scenes.h"

namespace trace::test::sky_table_test {
namespace {

/// Dark, with a band at 45 to 50 degrees of elevation that is bright.
Scene banded() {
  Scene scene;
  const Color dark(0.1), bright(20);
  scene.background.gradient = {dark, dark, bright, bright, dark, dark};
  scene.background.elevations = {-90, 45, 45.001, 50, 50.001, 90};
  return scene;
}

TEST(SkyTable, IsEmptyWhereThereIsNothingToGain) {
  EXPECT_TRUE(SkyTable(build(Scene{}).outside(), 0).empty());
  Scene even;
  even.background.gradient = {Color(1)};
  EXPECT_TRUE(SkyTable(build(even).outside(), 0).empty());
  EXPECT_FALSE(SkyTable(build(banded()).outside(), 0).empty());
}

TEST(SkyTable, ChoosesWithTheDensityItSays) {
  const World world = build(banded());
  const SkyTable table(world.outside(), 0);
  Real sum = 0, light = 0;
  constexpr int kSide = 400;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Vec3 direction = table.choose({(i + 0.5) / kSide, (j + 0.5) / kSide});
      EXPECT_NEAR(length(direction), 1, 1e-12);
      const Real density = table.density(direction);
      ASSERT_GT(density, 0);
      sum += 1 / density;  // the mean is the solid angle of all directions
      light += world.outside().view({{}, direction}, RayKind::bounce).color.g / density;
    }
  EXPECT_NEAR(sum / (kSide * kSide) / (4 * kPi), 1, 0.01);
  const auto band = [](Real from, Real to) {
    return 2 * kPi * (std::sin(to * kPi / 180) - std::sin(from * kPi / 180));
  };
  EXPECT_NEAR(light / (kSide * kSide) / (0.1 * (4 * kPi - band(45, 50)) + 20 * band(45, 50)), 1, 0.01);
}

TEST(SkyTable, PathsFindTheLightAndLessNoise) {
  Scene scene = banded();
  Phong white;
  white.diffuse = Color(1);
  addObject(scene, Square{}, Affine::rotation({1, 0, 0}, -kPi / 2) * Affine::scaling({9, 9, 1}), white);
  scene.camera.position = {0, 3, 3};
  scene.camera.viewdir = {0, -3, -3};
  scene.camera.fov = 10;
  Settings settings;
  settings.width = settings.height = 16;
  settings.integrator = IntegratorKind::path;
  settings.sampling = SampleKind::sobol;
  settings.depth = 2;
  settings.spp = 64;
  const Picture seen = picture(scene, settings);
  const auto sine2 = [](Real degrees) { return std::pow(std::sin(degrees * kPi / 180), 2); };
  const Real band = sine2(50) - sine2(45), expected = 0.1 * (1 - band) + 20 * band;
  Real sum = 0, squares = 0;
  for (const Color& c : seen.pixels) {
    sum += c.g;
    squares += (c.g - expected) * (c.g - expected);
  }
  const auto count = static_cast<Real>(seen.pixels.size());
  EXPECT_NEAR(sum / count / expected, 1, 0.005);
  EXPECT_LT(std::sqrt(squares / count), 0.03 * expected) << "bounced rays alone have about 0.3";
}

}  // namespace
}  // namespace trace::test::sky_table_test
