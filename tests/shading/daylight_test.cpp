// The sky by day against the formulas of the paper, worked out apart.
#include "shading/optics/daylight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shading/background.h"

namespace trace {
namespace {

Vec3 sunAt(Real degreesFromTop) {
  const Real angle = degreesFromTop * kPi / 180;
  return {std::sin(angle), std::cos(angle), 0};
}

/// Turbidity 2, sun in the zenith: chi = (4/9 - 1/60) pi = 1.343904, tan chi = 4.331476, so that
/// Y = 3.1196 * 4.331476 - 0.431 + 2.4192; x and y are the last column of the tables.
TEST(Daylight, HasTheZenithOfThePaper) {
  const ColorXyY noon = Daylight(2, {0, 1, 0}).zenith();
  EXPECT_NEAR(noon.Y, 15.50067, 1e-4);
  EXPECT_NEAR(noon.x, 2 * 0.00394 + 0.25886, 1e-12);
  EXPECT_NEAR(noon.y, 2 * 0.00516 + 0.26688, 1e-12);
  const ColorXyY morning = Daylight(3, sunAt(45)).zenith();
  EXPECT_NEAR(morning.Y,
              (4.0453 * 3 - 4.9710) * std::tan((4.0 / 9 - 3.0 / 120) * kPi / 2) - 0.2155 * 3 + 2.4192, 1e-12);
  const Real s = kPi / 4;
  EXPECT_NEAR(morning.x,
              9 * (0.00166 * s * s * s - 0.00375 * s * s + 0.00209 * s) +
                  3 * (-0.02903 * s * s * s + 0.06377 * s * s - 0.03202 * s + 0.00394) + 0.11693 * s * s * s -
                  0.21196 * s * s + 0.06052 * s + 0.25886,
              1e-12);
  EXPECT_NEAR(morning.y,
              9 * (0.00275 * s * s * s - 0.00610 * s * s + 0.00317 * s) +
                  3 * (-0.04214 * s * s * s + 0.08970 * s * s - 0.04153 * s + 0.00516) + 0.15346 * s * s * s -
                  0.26756 * s * s + 0.06670 * s + 0.26688,
              1e-12);
}

TEST(Daylight, IsItsZenithInTheZenith) {
  for (const Real turbidity : {2.0, 4.0, 8.0})
    for (const Real sun : {0.0, 30.0, 60.0, 85.0}) {
      const Daylight sky(turbidity, sunAt(sun));
      const ColorXyY above = sky.at({0, 1, 0});
      EXPECT_NEAR(above.Y, sky.zenith().Y, 1e-9);
      EXPECT_NEAR(above.x, sky.zenith().x, 1e-12);
      EXPECT_NEAR(above.y, sky.zenith().y, 1e-12);
    }
}

TEST(Daylight, IsBrighterNearTheSunAndBlueAwayFromIt) {
  const Daylight sky(3, sunAt(50));
  EXPECT_GT(sky.at(sunAt(50)).Y, 2 * sky.at(sunAt(-50)).Y);
  const Color blue = toColor(sky.at(sunAt(-40)));
  EXPECT_GT(blue.b, 1.5 * blue.r);
  EXPECT_GT(blue.g, blue.r);
}

TEST(Daylight, IsFiniteAndNotNegativeEverywhere) {
  for (const Real turbidity : {0.1, 1.7, 2.0, 5.0, 10.0, 50.0})
    for (const Vec3& sun :
         {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{1, -2, 0}, Vec3{0, -1, 0}, Vec3{1e-300, 1, 0}}) {
      const Daylight sky(turbidity, sun);
      for (Real angle = -180; angle <= 180; angle += 7.5) {
        const Color color = toColor(sky.at(sunAt(angle)));
        EXPECT_TRUE(isFinite(color)) << turbidity << " " << angle;
        EXPECT_TRUE(color.r >= 0 && color.g >= 0 && color.b >= 0);
      }
    }
}

TEST(Daylight, IsOneAtTheHorizonAndBelow) {
  const Daylight sky(4, sunAt(60));
  EXPECT_EQ(sky.at({0.6, 0, 0.8}).Y, sky.at(normalize(Vec3{0.6, -0.5, 0.8})).Y);
}

TEST(Daylight, WhiteIsWhite) {
  const Color white = toColor({0.3127, 0.3290, 1});
  EXPECT_NEAR(white.r, 1, 1e-3);
  EXPECT_NEAR(white.g, 1, 1e-3);
  EXPECT_NEAR(white.b, 1, 1e-3);
}

TEST(Background, GradientsAreBetweenTheirColorsByHeight) {
  Background sky;
  sky.gradient = {Color(0), Color(1), Color(3)};
  EXPECT_EQ(sky.gradientAt(-90), Color(0));
  EXPECT_EQ(sky.gradientAt(0), Color(1));
  EXPECT_EQ(sky.gradientAt(45), Color(2));
  EXPECT_EQ(sky.gradientAt(90), Color(3));
  sky.elevations = {0, 10, 90};
  EXPECT_EQ(sky.gradientAt(-5), Color(0));
  EXPECT_EQ(sky.gradientAt(5), Color(0.5));
  EXPECT_EQ(sky.gradientAt(50), Color(2));
  EXPECT_EQ(sky.gradientAt(90), Color(3));
}

}  // namespace
}  // namespace trace
