#include "shading/optics/dispersion.h"

#include <gtest/gtest.h>

#include "shading/interior.h"

namespace trace::test {
namespace {

Real abbeOf(const Dispersion& d, Real index) {
  return (d.index(index, kLineD) - 1) / (d.index(index, kLineF) - d.index(index, kLineC));
}

TEST(Dispersion, GlassesHaveTheIndicesOfTheirCatalogue) {
  // Schott's catalogue: n_d and Abbe's number.
  const std::tuple<Disperses, Real, Real> table[]{
      {Disperses::bk7, 1.51680, 64.17},   {Disperses::baf10, 1.67003, 47.11},
      {Disperses::fk51a, 1.48656, 84.47}, {Disperses::lasf9, 1.85025, 32.17},
      {Disperses::sf5, 1.67271, 32.21},   {Disperses::sf10, 1.72825, 28.41},
      {Disperses::sf11, 1.78472, 25.76}};
  for (const auto& [glass, index, abbe] : table) {
    EXPECT_NEAR(sellmeier(glass)->index(kLineD), index, 2e-5);
    EXPECT_NEAR(abbeOf({glass, 0, index}, index), abbe, 0.02);
  }
  // Measured at single wavelengths, from the same.
  EXPECT_NEAR(sellmeier(Disperses::bk7)->index(366), 1.53609, 2e-5);
  EXPECT_NEAR(sellmeier(Disperses::bk7)->index(300), 1.55277, 2e-5);
}

TEST(Dispersion, CauchysFormulaHasTheIndexAndAbbesNumberThatItIsMadeOf) {
  for (Real index : {1.333, 1.5168, 2.417})
    for (Real abbe : {20.0, 55.0, 90.0}) {
      const Dispersion d(Disperses::byAbbe, abbe, index);
      EXPECT_NEAR(d.index(index, kLineD), index, 1e-15);
      EXPECT_NEAR(abbeOf(d, index), abbe, 1e-9);
      EXPECT_GT(d.index(index, 400), d.index(index, 700));
    }
  const Dispersion bk7(Disperses::byAbbe, 64.17, 1.5168);
  EXPECT_NEAR(bk7.index(1.5168, 400), sellmeier(Disperses::bk7)->index(400), 3e-4);
}

TEST(Dispersion, LightOfAllColoursHasTheIndexAsItIsGiven) {
  EXPECT_TRUE(Dispersion().none());
  EXPECT_TRUE(Dispersion(Disperses::byAbbe, 0, 1.5).none());
  EXPECT_EQ(Dispersion().index(1.5, 450), 1.5);
  EXPECT_EQ(Dispersion(Disperses::sf11, 0, 1.7).index(1.7, 0), 1.7);
}

TEST(Dispersion, AFanOfWavelengthsIsWhite) {
  for (int count : {1, 2, 3, 7, 16, 100, 1000})
    for (Real shift : {0.0, 0.3, 0.5, 0.96875}) {
      Color sum;
      for (const SpectralShare& share : spectralFan(count, shift)) {
        sum += share.weight;
        EXPECT_GE(share.nanometres, 400);
        EXPECT_LE(share.nanometres, 700);
        EXPECT_TRUE(share.weight.r >= 0 && share.weight.g >= 0 && share.weight.b >= 0);
      }
      EXPECT_EQ(sum, Color(1)) << count << " " << shift;
    }
}

TEST(Dispersion, WavelengthsHaveTheirColours) {
  const Color red = spectralColor(640), green = spectralColor(540), blue = spectralColor(450);
  EXPECT_TRUE(red.r > 10 * std::abs(red.g) && red.r > 10 * std::abs(red.b));
  EXPECT_TRUE(green.g > green.r && green.g > green.b);
  EXPECT_TRUE(blue.b > blue.r && blue.b > blue.g);
  // The observer of 1931: at 555 nm x, y, z = 0.512050, 1.000000, 0.005750; the fit is good to 0.02.
  const Color c = spectralColor(555);
  EXPECT_NEAR(0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b, 1, 0.02);
}

TEST(Interior, BeersLawReachesTheColourAtItsDistance) {
  Interior interior;
  EXPECT_EQ(interior.passesPerUnit(), Color(1));
  interior.attenuationColor = {0.25, 1, 0.5}, interior.attenuationDistance = 2;
  const Color passes = pow(interior.passesPerUnit(), 2);
  EXPECT_NEAR(passes.r, 0.25, 1e-15);
  EXPECT_EQ(passes.g, 1);
  EXPECT_NEAR(passes.b, 0.5, 1e-15);
}

}  // namespace
}  // namespace trace::test
