#include "shading/optics/fresnel.h"

#include <gtest/gtest.h>

#include "shading/optics/optics.h"

namespace trace::test {
namespace {

Real cosineOf(Real degrees) { return std::cos(degrees * kPi / 180); }

TEST(Fresnel, HasTheValuesOfGlassOfIndexOneAndAHalf) {
  const std::pair<Real, Real> table[]{{0, 0.040000},  {30, 0.041523}, {45, 0.050240},
                                      {60, 0.089187}, {75, 0.253061}, {85, 0.612800}};
  for (const auto& [degrees, share] : table)
    EXPECT_NEAR(fresnelDielectric(cosineOf(degrees), 1, 1.5), share, 5e-7) << degrees;
  for (Real n : {1.1, 1.333, 1.5, 2.4})
    EXPECT_NEAR(fresnelDielectric(1, 1, n), (n - 1) / (n + 1) * ((n - 1) / (n + 1)), 1e-15);
  EXPECT_EQ(fresnelDielectric(0, 1, 1.5), 1);
}

TEST(Fresnel, MirrorsNothingOfTheLightInThePlaneAtBrewstersAngle) {
  const Real angle = std::atan(1.5) * 180 / kPi;
  EXPECT_NEAR(angle, 56.30993, 1e-5);
  const Reflectance r = reflectanceDielectric(cosineOf(angle), 1, 1.5);
  EXPECT_NEAR(r.p, 0, 1e-15);
  EXPECT_NEAR(r.s, 0.147929, 5e-7);
  EXPECT_NEAR((r.s + r.p) / 2, 0.073964, 5e-7);
}

TEST(Fresnel, IsTheSameBothWaysAndTotalBeyondTheCriticalAngle) {
  for (Real degrees = 0; degrees < 90; degrees += 1.5) {
    const Real inside = std::asin(std::sin(degrees * kPi / 180) / 1.5);
    EXPECT_NEAR(fresnelDielectric(cosineOf(degrees), 1, 1.5), fresnelDielectric(std::cos(inside), 1.5, 1),
                1e-12);
  }
  EXPECT_NEAR(std::asin(1 / 1.5) * 180 / kPi, 41.81031, 1e-5);
  EXPECT_EQ(fresnelDielectric(cosineOf(41.8104), 1.5, 1), 1);
  EXPECT_LT(fresnelDielectric(cosineOf(41.8102), 1.5, 1), 1);
  EXPECT_EQ(fresnelDielectric(0.3, 1.5, 1.5), 0) << "no surface";
  EXPECT_EQ(fresnelDielectric(0, 1.5, 1.5), 0);
}

TEST(Fresnel, HasTheKnownMeanOverTheHemisphere) {
  for (const auto& [before, behind, mean] : {std::tuple{1.0, 1.5, 0.091778}, {1.5, 1.0, 0.596346}}) {
    Real sum = 0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i)  // of cos^2 from 0 to 1, which are equal shares of a Lambertian's light
      sum += fresnelDielectric(std::sqrt((i + 0.5) / kSteps), before, behind);
    EXPECT_NEAR(sum / kSteps, mean, 2e-6);
  }
}

}  // namespace
}  // namespace trace::test
