// What is done between the light gathered and the values shown.
#include "image/development/development.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/srgb.h"

namespace trace {
namespace {

Picture ramp(double most) {
  Picture picture(64, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 64; ++x) picture.at(x, y) = Color(most * x / 63, most * x / 126, most * x / 400);
  return picture;
}

TEST(Development, ByDefaultNothingHappens) { EXPECT_EQ(developed(ramp(3), {}), ramp(3)); }

TEST(Development, ExposureIsAPowerOfTwo) {
  EXPECT_EQ(developed(Color(0.25, 0.5, 1), {.exposure = 2}), Color(1, 2, 4));
  EXPECT_EQ(developed(Color(1), {.exposure = -1}), Color(0.5));
}

TEST(Development, SrgbIsTheStandardsCurve) {
  EXPECT_EQ(srgbOfLinear(0), 0);
  EXPECT_NEAR(srgbOfLinear(1), 1, 1e-15);
  EXPECT_NEAR(srgbOfLinear(0.5), 0.735356983052449, 1e-12);
  EXPECT_NEAR(srgbOfLinear(0.001), 0.01292, 1e-12);
  for (double v = 0; v <= 1; v += 1.0 / 64) EXPECT_NEAR(linearOfSrgb(srgbOfLinear(v)), v, 1e-7) << v;
}

TEST(Development, CurvesRiseAndStayBelowOne) {
  for (const Tone tone : {Tone::reinhard, Tone::filmic, Tone::agx}) {
    double last = -1;
    for (double v = 0; v < 1e4; v = v * 1.3 + 1e-3) {
      const Color c = developed(Color(v), {.tone = tone});
      EXPECT_GE(c.g, last - 1e-12) << v;
      EXPECT_LE(c.g, 1 + 1e-9) << v;
      EXPECT_GE(c.g, -1e-3) << v;
      EXPECT_NEAR(c.r, c.g, 0.01) << "grey stays grey, " << v;
      EXPECT_NEAR(c.b, c.g, 0.01) << "grey stays grey, " << v;
      last = c.g;
    }
    EXPECT_GT(last, 0.9);
  }
  EXPECT_NEAR(developed(Color(1), {.tone = Tone::reinhard}).g, 0.5, 1e-6);
}

TEST(Development, WhiteBalanceMakesItsLightWhite) {
  // A black body of 3200 K in linear sRGB (CIE, luminance 1): x = 0.4234, y = 0.3990.
  const double x = 0.4234, y = 0.3990, X = x / y, Z = (1 - x - y) / y;
  const Color lamp{3.2404542 * X - 1.5371385 - 0.4985314 * Z, -0.9692660 * X + 1.8760108 + 0.0415560 * Z,
                   0.0556434 * X - 0.2040259 + 1.0572252 * Z};
  EXPECT_GT(lamp.r, 1.5 * lamp.b);
  const Color white = developed(lamp, {.whiteBalance = 3200});
  EXPECT_NEAR(white.r, 1, 0.01);
  EXPECT_NEAR(white.g, 1, 0.01);
  EXPECT_NEAR(white.b, 1, 0.01);
  const Color blue = developed(Color(1), {.whiteBalance = 3200});
  EXPECT_GT(blue.b, blue.r) << "what was white is bluer";
}

TEST(Development, BloomKeepsTheLight) {
  Picture picture(101, 81);
  picture.at(50, 40) = Color(100);
  const Picture bloomed = developed(picture, {.bloom = 0.2});
  double sum = 0;
  for (const Color& c : bloomed.pixels) sum += c.r;
  EXPECT_NEAR(sum, 100, 0.5);
  EXPECT_GT(bloomed.at(53, 40).r, bloomed.at(58, 40).r);
  EXPECT_GT(bloomed.at(58, 40).r, 0);
  EXPECT_NEAR(bloomed.at(53, 40).r, bloomed.at(47, 40).r, 1e-9);
  EXPECT_NEAR(bloomed.at(53, 40).r, bloomed.at(50, 43).r, 1e-6);
}

TEST(Development, BloomLeavesOutWhatIsNoNumber) {
  Picture picture(9, 9);
  picture.at(2, 2) = Color(std::numeric_limits<double>::infinity());
  EXPECT_EQ(developed(picture, {.bloom = 0.5}).at(6, 6), Color(0));
}

TEST(Development, DitherKeepsTheMean) {
  Picture picture(200, 200);
  for (Color& c : picture.pixels) c = Color(100.3 / 255);
  const Bytes bytes = toBytes(developed(picture, {.dither = true}), Rounding::nearest);
  double sum = 0;
  for (const std::uint8_t level : bytes.rgb) {
    EXPECT_GE(level, 99);
    EXPECT_LE(level, 102);
    sum += level;
  }
  EXPECT_NEAR(sum / static_cast<double>(bytes.rgb.size()), 100.3, 0.02);
}

TEST(Development, OneColourGoesThePicturesWay) {
  const Development all{.exposure = 0.7, .whiteBalance = 4200, .tone = Tone::agx, .transfer = Transfer::srgb};
  const Picture picture = ramp(4), result = developed(picture, all);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    EXPECT_EQ(developed(picture.pixels[i], all), result.pixels[i]);
}

TEST(Development, AWorkingGammaMakesLightOfTheValues) {
  const Color shown = developed(Color(0.5), Development{.workingGamma = 2.2, .transfer = Transfer::srgb});
  EXPECT_NEAR(shown.r, srgbOfLinear(std::pow(0.5, 2.2)), 1e-12);
  EXPECT_EQ(developed(Color(0.5), Development{.workingGamma = 1}).r, 0.5);
  Picture picture(1, 1);
  picture.at(0, 0) = Color(0.25, 1, 0);
  const Picture all = developed(picture, Development{.workingGamma = 1.5});
  EXPECT_NEAR(all.at(0, 0).r, 0.125, 1e-12);
  EXPECT_EQ(all.at(0, 0).g, 1);
  EXPECT_EQ(all.at(0, 0).b, 0);
}

TEST(Development, LevelsAreThoseOfTheDevelopedPicture) {
  Picture picture = ramp(7);
  picture.pixels.front() = Color(3, -1, 0.2);
  for (const Development& d :
       {Development{}, Development{.exposure = 1, .whiteBalance = 3200, .transfer = Transfer::srgb},
        Development{.tone = Tone::agx, .workingGamma = 2.2},
        Development{.exposure = -1, .tone = Tone::stretch}, Development{.bloom = 0.2},
        Development{.dither = true}})
    for (const Rounding rounding : {Rounding::truncate, Rounding::nearest})
      EXPECT_EQ(developedBytes(picture, d, rounding), toBytes(developed(picture, d), rounding));
}

}  // namespace
}  // namespace trace
