// What the studio shows of a picture: exposure, levels, differences, false colours.
#include "app/picture_views.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trace::test {
namespace {

TEST(PictureViews, ExposureIsInStopsAndZeroStopsAreTheLevelsOfAFile) {
  Picture picture(1, 1);
  picture.at(0, 0) = {0.25, 0.5, 2};
  EXPECT_EQ(exposed(picture, 0, Rounding::truncate), toBytes(picture, Rounding::truncate));
  EXPECT_EQ(exposed(picture, 1, Rounding::truncate).rgb, (std::vector<std::uint8_t>{127, 255, 255}));
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

}  // namespace
}  // namespace trace::test
