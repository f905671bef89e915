// Levels from colours: the two roundings to the last value, and numbers that are none.
#include "image/development/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trace {
namespace {

TEST(Tone, RoundsAsTheCoursesDo) {
  EXPECT_EQ(toLevel(0.5, Rounding::truncate), 127);
  EXPECT_EQ(toLevel(0.5, Rounding::nearest), 128);
  EXPECT_EQ(toLevel(1.0, Rounding::truncate), 255);
  EXPECT_EQ(toLevel(1.0, Rounding::nearest), 255);
  EXPECT_EQ(toLevel(std::nextafter(1.0, 0.0), Rounding::truncate), 254);
  EXPECT_EQ(toLevel(std::nextafter(1.0, 0.0), Rounding::nearest), 255);
  EXPECT_EQ(toLevel(0.0, Rounding::truncate), 0);
  EXPECT_EQ(toLevel(0.49 / 255, Rounding::nearest), 0);
  EXPECT_EQ(toLevel(0.51 / 255, Rounding::nearest), 1);
}

TEST(Tone, ClampsAndMakesNanBlack) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (Rounding rounding : {Rounding::truncate, Rounding::nearest}) {
    EXPECT_EQ(toLevel(std::numeric_limits<double>::quiet_NaN(), rounding), 0);
    EXPECT_EQ(toLevel(kInfinity, rounding), 255);
    EXPECT_EQ(toLevel(-kInfinity, rounding), 0);
    EXPECT_EQ(toLevel(-0.7, rounding), 0);
    EXPECT_EQ(toLevel(-0.0, rounding), 0);
    EXPECT_EQ(toLevel(1e300, rounding), 255);
  }
}

TEST(Tone, EveryLevelComesBack) {
  Bytes bytes{256, 1, {}};
  for (int level = 0; level < 256; ++level)
    for (int channel = 0; channel < 3; ++channel) bytes.rgb.push_back(static_cast<std::uint8_t>(level));
  EXPECT_EQ(toBytes(fromBytes(bytes), Rounding::truncate), bytes);
  EXPECT_EQ(toBytes(fromBytes(bytes), Rounding::nearest), bytes);
}

TEST(Tone, KeepsTheOrderOfChannelsAndRows) {
  Picture picture(1, 2);
  picture.at(0, 0) = {1, 0, 0};
  picture.at(0, 1) = {0, 1, 0.5};
  EXPECT_EQ(toBytes(picture, Rounding::truncate), (Bytes{1, 2, {255, 0, 0, 0, 255, 127}}));
}

TEST(Tone, StretchMapsTheLeastToZeroAndTheLargestToOne) {
  Picture picture(2, 1);
  picture.at(0, 0) = {2, 4, 6};
  picture.at(1, 0) = {-2, 0, 3};
  EXPECT_EQ(finiteRange(picture), (ValueRange{-2, 6}));
  EXPECT_EQ(toned(picture, Tone::clamp), picture);
  const Picture stretched = toned(picture, Tone::stretch);
  EXPECT_EQ(stretched.at(0, 0), Color(0.5, 0.75, 1));
  EXPECT_EQ(stretched.at(1, 0), Color(0, 0.25, 0.625));
}

TEST(Tone, StretchPassesOverWhatIsNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Picture picture(2, 1);
  picture.at(0, 0) = {kInfinity, 1, std::numeric_limits<double>::quiet_NaN()};
  picture.at(1, 0) = {3, -kInfinity, 2};
  EXPECT_EQ(finiteRange(picture), (ValueRange{1, 3}));
  EXPECT_EQ(toBytes(toned(picture, Tone::stretch), Rounding::truncate),
            (Bytes{2, 1, {255, 0, 0, 255, 0, 127}}));
}

TEST(Tone, StretchLeavesAPictureOfOneValue) {
  Picture picture(3, 1);
  for (Color& c : picture.pixels) c = Color(0.25);
  EXPECT_EQ(toned(picture, Tone::stretch), picture);
  EXPECT_EQ(toned(Picture(), Tone::stretch), Picture());
  EXPECT_EQ(finiteRange(Picture()), ValueRange{});
}

TEST(Tone, EmptyPicture) {
  EXPECT_EQ(toBytes(Picture(), Rounding::nearest), Bytes());
  EXPECT_EQ(fromBytes(Bytes()), Picture());
}

}  // namespace
}  // namespace trace
