// Directions by the brightness of what is around.
#include "render/lights/sky_table.h"

#include <gtest/gtest.h>

#include "geometry/shapes/solids/square.h"
#include "image/srgb.h"
#include "math/elementary.h"
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

TEST(SkyTable, WorldsWithTheSameEnvironmentShareTheirSums) {
  Scene scene = banded();
  const Settings settings;
  Messages messages;
  const World first = compile(scene, settings, messages);
  const Compiled before{scene, settings, first};
  const auto sums = first.outside().skySums(2);
  Scene moved = scene;
  moved.camera.position = {1, 2, 3};
  addObject(moved, Square{}, {}, {});
  EXPECT_EQ(compile(moved, settings, messages, &before).outside().skySums(2), sums);
  Scene other = scene;
  other.background.gradient[3] = Color(19);
  Settings brighter;
  brighter.environmentBrightness = 1.5;
  for (const World& world :
       {compile(other, settings, messages, &before), compile(scene, brighter, messages, &before)}) {
    EXPECT_NE(world.outside().skySums(2), sums);
    EXPECT_NE(world.outside().skySums(2)->rows, sums->rows);
  }
}

/// Each sum is that of the colours themselves, though directions of one height are looked up together.
TEST(SkyTable, SumsAreExact) {
  Scene daylight, smooth;
  daylight.background.turbidity = 3;
  smooth.background.gradient = {Color(0.1, 0.3, 0.5), Color(0.9, 0.2, 0.4), Color(0.3, 0.7, 9)};
  for (const Scene& scene : {banded(), daylight, smooth}) {
    const World world = build(scene);
    const SkySums& sums = *world.outside().skySums(2);
    Real all = 0;
    for (int row = 0; row < 140; ++row) {  // past the band
      Real sum = 0;
      for (int column = 0; column < SkySums::kColumns; ++column) {
        Real light = 0;
        for (int i = 0; i < 4; ++i) {
          const Real y = 1 - 2 * ((row + (i / 2 + 0.5) / 2) / SkySums::kRows), flat = std::sqrt(1 - y * y);
          const math::SinCos angle =
              math::sincos(2 * kPi * ((column + (i % 2 + 0.5) / 2) / SkySums::kColumns));
          light += luminanceOf(
              world.outside().view({{}, {flat * angle.cos, y, flat * angle.sin}}, RayKind::bounce).color);
        }
        sum += light;
        ASSERT_EQ(sums.inRows[SkySums::cell(row, column)], static_cast<float>(sum)) << row << ", " << column;
      }
      ASSERT_EQ(sums.rows[static_cast<std::size_t>(row)], all += sum) << row;
    }
  }
}

/// Gradients that are surely even are found without the sums. The bound is above the true ratio, and close.
TEST(SkyTable, KnowsEvenGradients) {
  for (const Real bright : {0.2, 0.5, 2.0, 5.0, 20.0}) {
    Scene scene = banded();
    scene.background.gradient[2] = scene.background.gradient[3] = Color(bright);
    scene.background.elevations = {-90, 10, 10.001, 50, 50.001, 90};
    const World world = build(scene);
    const SkySums& sums = *world.outside().skySums(2);
    const Real ratio = sums.brightest * SkySums::kColumns * SkySums::kRows / sums.rows.back();
    EXPECT_GT(world.outside().unevennessOfGradient(), 0.99 * ratio) << bright;
    EXPECT_LT(world.outside().unevennessOfGradient(), 1.2 * ratio) << bright;
    EXPECT_EQ(SkyTable(world.outside(), 2).empty(), !(ratio > 3)) << bright;
  }
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
