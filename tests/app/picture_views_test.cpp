// What the studio shows of a picture: exposure, levels, differences, false colours.
#include "app/view/picture_views.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/session/session.h"
#include "geometry/shapes/solids/sphere.h"
#include "support/scenes.h"

namespace trace::test {
namespace {

TEST(PictureViews, ExposureIsInStopsAndZeroStopsAreTheLevelsOfAFile) {
  Picture picture(1, 1);
  picture.at(0, 0) = {0.25, 0.5, 2};
  EXPECT_EQ(exposed(picture, 0, Rounding::truncate), toBytes(picture, Rounding::truncate));
  EXPECT_EQ(exposed(picture, 1, Rounding::truncate).rgb, (std::vector<std::uint8_t>{127, 255, 255}));
}

TEST(PictureViews, ATooLargePictureIsShownByMeansOfItsBlocks) {
  Bytes wide;
  wide.width = 5, wide.height = 2;
  for (int i = 0; i < 10; ++i) wide.rgb.insert(wide.rgb.end(), {static_cast<std::uint8_t>(10 * i), 7, 9});
  EXPECT_EQ(fewerPixels(wide, 5), wide);
  const Bytes fewer = fewerPixels(wide, 2);  // blocks of three
  EXPECT_EQ(fewer.width, 2);
  EXPECT_EQ(fewer.height, 2);
  EXPECT_EQ(fewer.rgb, (std::vector<std::uint8_t>{10, 7, 9, 35, 7, 9, 60, 7, 9, 85, 7, 9}));
}

TEST(PictureViews, WhatIsBrighterThanOneDoesNotDifferFromAFileThatCannotKeepIt) {
  Picture picture(1, 1);
  picture.at(0, 0) = {0.25, 1, 2.5};
  Picture file(1, 1);
  file.at(0, 0) = {0.25, 1, 1};
  EXPECT_EQ(differences(clamped(picture), file, 1).at(0, 0), Color(0));
}

TEST(PictureViews, ThePixelsLevelsAreThoseOfTheTone) {
  Picture picture(2, 1);
  picture.at(0, 0) = Color(1), picture.at(1, 0) = Color(3);
  const Picture stretched = toned(picture, Tone::stretch);
  EXPECT_EQ(pixelText(picture.at(1, 0), stretched.at(1, 0), Rounding::nearest), "3  3  3   (255 255 255)");
  EXPECT_EQ(pixelText(picture.at(0, 0), stretched.at(0, 0), Rounding::nearest), "1  1  1   (0 0 0)");
}

TEST(PictureViews, AChannelAloneIsGrey) {
  Picture picture(1, 1);
  picture.at(0, 0) = {0.25, 0.5, 1};
  EXPECT_EQ(channelOf(picture, ShownChannel::all).at(0, 0), picture.at(0, 0));
  EXPECT_EQ(channelOf(picture, ShownChannel::green).at(0, 0), Color(0.5));
  EXPECT_NEAR(channelOf(picture, ShownChannel::luminance).at(0, 0).g, 0.299 * 0.25 + 0.587 * 0.5 + 0.114,
              1e-12);
}

TEST(PictureViews, AHistogramCountsEveryPixelOnceInEachChannel) {
  Picture picture(4, 1);
  picture.at(0, 0) = {-1, 0.5, 2};
  picture.at(1, 0) = {0, 0.5, std::nan("")};
  picture.at(2, 0) = {1, 0.5, 0.25};
  picture.at(3, 0) = {0.999, 0.1, 0.25};
  const Histogram histogram = histogramOf(picture);
  EXPECT_EQ(histogram.counts[0].front(), 2);
  EXPECT_EQ(histogram.counts[0].back(), 2);
  EXPECT_EQ(histogram.counts[1][Histogram::kBins / 2], 3);
  for (const auto& channel : histogram.counts) {
    int all = 0;
    for (const int count : channel) all += count;
    EXPECT_EQ(all, 4);
  }
  EXPECT_EQ(histogram.most, 3);
}

TEST(PictureViews, TheErrorOfAPictureIsSaidInNumbers) {
  Picture picture(2, 1), other(2, 1);
  picture.at(0, 0) = other.at(0, 0) = Color(0.5);
  EXPECT_EQ(differenceText(picture, other), "the pictures are the same");
  other.at(1, 0) = Color(0.5);
  EXPECT_EQ(differenceText(picture, other),
            "RMSE 0.354, mean 0.25, largest 0.5 at 1, 0; PSNR 9.0 dB; 50 % of pixels differ");
}

/// A film of two pixels and four samples: the left one sees 0.5, the right one 0 and 1 by turns.
Film twoPixels(int waves) {
  Film film(2, 1, 4);
  for (int wave = 0; wave < waves; ++wave) {
    TileSamples samples{.area = {0, 0, 2, 1}, .colors = {}, .layers = {}};
    const Wave& w = film.waves()[static_cast<std::size_t>(wave)];
    for (int k = w.first; k < w.end; ++k) samples.colors.push_back(Color(0.5));
    for (int k = w.first; k < w.end; ++k) samples.colors.push_back(Color(k % 2));
    film.add(0, static_cast<std::size_t>(wave), samples);
  }
  return film;
}

TEST(PictureViews, ConvergenceIsTheErrorThatIsLeft) {
  const Convergence all = twoPixels(3).convergence();
  EXPECT_EQ(all.samples, 4);
  EXPECT_TRUE(all.judged);
  EXPECT_NEAR(all.error, std::sqrt(0.25 * 4 / 3 / 4) / 2, 1e-6);
  EXPECT_EQ(convergenceText(all), "4 samples a pixel, noise 36.8 levels");
  EXPECT_FALSE(twoPixels(1).convergence().judged) << "one sample tells nothing";
  EXPECT_EQ(convergenceText(twoPixels(1).convergence()), "1 sample a pixel");
  EXPECT_LT(twoPixels(3).convergence().error, twoPixels(2).convergence().error) << "it falls";
}

TEST(PictureViews, PlanesAreHeatMapsWithALegend) {
  const Film film = twoPixels(3);
  const Picture shown = film.picture();
  const PlaneView samples = planeView(FilmPlane::samples, film, shown);
  EXPECT_EQ(samples.colours.at(0, 0), Color(1)) << "the most";
  EXPECT_EQ(samples.legend, "4 rays in every pixel");
  const PlaneView noise = planeView(FilmPlane::noise, film, shown);
  EXPECT_EQ(noise.colours.at(0, 0), Color(0));
  EXPECT_EQ(noise.colours.at(1, 0), Color(1));
  EXPECT_NE(noise.legend.find("36.8 on the average"), std::string::npos) << noise.legend;
  const Film one = twoPixels(1);
  EXPECT_NE(planeView(FilmPlane::noise, one, one.picture()).legend.find("not known"), std::string::npos);
  EXPECT_NE(planeView(FilmPlane::change, film, shown).legend.find("denoise is off"), std::string::npos);
}

TEST(PictureViews, AHeatMapHasAScaleWithNumbers) {
  const Film film = twoPixels(3);
  const PlaneView samples = planeView(FilmPlane::samples, film, film.picture());
  EXPECT_EQ(samples.values.at(1, 0).r, 4);
  EXPECT_EQ(samples.scale.text(samples.values.at(1, 0).r), "4 rays");
  const PlaneView noise = planeView(FilmPlane::noise, film, film.picture());
  EXPECT_EQ(noise.scale.white, 8);
  EXPECT_NEAR(noise.values.at(1, 0).r, 73.6, 0.1) << "levels";

  CostMap cost{nullptr, 1, Picture(2, 1)};
  EXPECT_NE(planeView(FilmPlane::cost, film, film.picture()).legend.find("being measured"),
            std::string::npos);
  cost.tests.at(0, 0) = Color(9), cost.tests.at(1, 0) = Color(99);
  const PlaneView work = planeView(FilmPlane::cost, film, film.picture(), cost);
  EXPECT_EQ(work.colours.at(1, 0), Color(1)) << "the most";
  EXPECT_NEAR(work.scale.shareOf(9), 0.5, 1e-12) << "each step of a colour is a factor";
  EXPECT_NEAR(work.scale.valueAt(0.5), 9, 1e-9);
  EXPECT_EQ(work.legend, "boxes and surfaces tested for a sample: 9 to 99; 54 on the average");
  EXPECT_EQ(work.scale.text(1240.4), "1240 tests");
}

TEST(PictureViews, FalseColoursAreBlackWithoutADifferenceAndGetBrighter) {
  Picture a(2, 1), b(2, 1);
  b.at(1, 0) = {0, 0, 0.5};
  const Picture difference = falseColours(a, b, 2);
  EXPECT_EQ(difference.at(0, 0), Color(0));
  EXPECT_EQ(difference.at(1, 0), Color(1));
  EXPECT_EQ(falseColour(std::nan("")), Color(1));
  double before = -1;
  for (double value : {0.0, 0.1, 0.2}) {
    const Color c = falseColour(value);
    EXPECT_GT(c.r + c.g + c.b, before);
    before = c.r + c.g + c.b;
  }
}

TEST(PictureViews, APictureOfAnotherSizeIsResampledByMeans) {
  Picture small(4, 2);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 2; ++y) small.at(x, y) = Color(x, y, 1);
  const Picture half = resampled(small, 2, 1), same = resampled(small, 4, 2), large = resampled(small, 8, 4);
  ASSERT_EQ(half.width, 2);
  EXPECT_NEAR(half.at(0, 0).r, 0.5, 1e-12);
  EXPECT_NEAR(half.at(1, 0).r, 2.5, 1e-12);
  EXPECT_NEAR(half.at(1, 0).g, 0.5, 1e-12);
  EXPECT_EQ(same.pixels, small.pixels);
  EXPECT_NEAR(large.at(7, 3).r, 3, 1e-12);
  EXPECT_NEAR(resampled(Picture(400, 267), 300, 200).at(150, 100).r, 0, 1e-12) << "as near as pixels allow";
  EXPECT_EQ(resampled(Picture(400, 300), 300, 200).width, 0);
}

TEST(PictureViews, PassesThatWereRenderedCanBeSeen) {
  Scene scene;
  addObject(scene, Sphere{}, {}, {});
  scene.camera.position = {0, 0, 4};
  Settings settings{.width = 16, .height = 16};
  settings.passes = {Pass::normal, Pass::depth};
  Session session;
  session.open(scene, settings);
  session.build();
  session.renderPicture();
  EXPECT_EQ(passesToSee(session.settings()), (std::vector<std::string_view>{"depth", "normal"}));
  const PlaneView normals =
      passView("normal", session.film(), session.settings(), session.names(), session.picture());
  EXPECT_NEAR(normals.colours.at(8, 8).b, 1, 0.05) << "toward the camera";
  EXPECT_NE(normals.legend.find("normal"), std::string::npos);
}

TEST(PictureViews, DifferencesAreMagnifiedUntilTheyAreSeen) {
  Picture apart(20, 20);
  EXPECT_EQ(magnificationFor(apart), 1);
  for (Color& c : apart.pixels) c = {0.01, 0.02, 0};
  EXPECT_EQ(magnificationFor(apart), 32);  // 0.64 of white
  apart.at(3, 3) = Color(1);               // one pixel of 400 may be white
  EXPECT_EQ(magnificationFor(apart), 32);
  for (Color& c : apart.pixels) c = Color(3);
  EXPECT_EQ(magnificationFor(apart), 1);
  for (Color& c : apart.pixels) c = Color(1e-9);
  EXPECT_EQ(magnificationFor(apart), 128);
}

TEST(PictureViews, APictureAndItsOwnFileHaveNoDifference) {
  Picture exact(3, 1);
  exact.pixels = {Color(0.1234), Color(0.5, 0.25, 0.001), Color(1)};
  for (const Rounding rounding : {Rounding::truncate, Rounding::nearest}) {
    const Picture file = roundedToLevels(exact, rounding);
    EXPECT_FALSE(holdsLevels(exact));
    EXPECT_TRUE(holdsLevels(file));
    EXPECT_EQ(differences(roundedToLevels(exact, rounding), file, 1), Picture(3, 1));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(file.pixels[i].r, exact.pixels[i].r, 1.01 / 255);
  }
}

}  // namespace
}  // namespace trace::test
