#include "image/development/anaglyph.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

Picture pair(const Color& left, const Color& right) {
  Picture both(2, 1);
  both.at(0, 0) = left;
  both.at(1, 0) = right;
  return both;
}

TEST(Anaglyph, RedIsTheLeftEyesCyanTheRights) {
  const Color left(0.9, 0.2, 0.4), right(0.3, 0.6, 0.7);
  EXPECT_EQ(anaglyph(pair(left, right), kRedCyan).at(0, 0), Color(0.9, 0.6, 0.7));
  const double luminance = 0.299 * 0.9 + 0.587 * 0.2 + 0.114 * 0.4;
  const Color half = anaglyph(pair(left, right), kHalfColor).at(0, 0);
  EXPECT_DOUBLE_EQ(half.r, luminance);
  EXPECT_EQ(half.g, 0.6);
  const Color grey = anaglyph(pair(left, right), kGrey).at(0, 0);
  EXPECT_DOUBLE_EQ(grey.r, luminance);
  EXPECT_DOUBLE_EQ(grey.g, 0.299 * 0.3 + 0.587 * 0.6 + 0.114 * 0.7);
  EXPECT_EQ(grey.g, grey.b);
}

TEST(Anaglyph, WhatBothEyesSeeWhiteIsNearlyWhite) {
  for (const Anaglyph* rules : {&kRedCyan, &kHalfColor, &kGrey, &kDubois}) {
    const Color white = anaglyph(pair(Color(1), Color(1)), *rules).at(0, 0);
    for (const double channel : {white.r, white.g, white.b}) EXPECT_NEAR(channel, 1, 0.02);
  }
}

TEST(Anaglyph, HalvesStandInTheirPlaces) {
  Picture both(4, 2);
  both.at(1, 1) = Color(1, 0, 0);
  both.at(2, 0) = Color(0, 1, 0);
  const Picture picture = anaglyph(both, kRedCyan);
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(picture.at(1, 1), Color(1, 0, 0));
  EXPECT_EQ(picture.at(0, 0), Color(0, 1, 0));
}

}  // namespace
}  // namespace trace
