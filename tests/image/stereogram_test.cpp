#include "image/development/stereogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trace {
namespace {

TEST(Stereogram, SeparationsAreThoseOfThePaper) {
  const StereogramRules rules;
  EXPECT_EQ(separation(0, rules), 90);
  EXPECT_EQ(separation(0.5, rules), 82);
  EXPECT_EQ(separation(1, rules), 72);
}

/// Two steps in front of a wall that is infinitely far.
Picture steps() {
  Picture distances(400, 60);
  for (int y = 0; y < distances.height; ++y)
    for (int x = 0; x < distances.width; ++x) {
      const bool inside = y >= 15 && y < 45;
      distances.at(x, y) = Color(inside && x >= 120 && x < 200   ? 2.0
                                 : inside && x >= 200 && x < 280 ? 3.0
                                                                 : std::numeric_limits<double>::infinity());
    }
  distances.at(0, 0) = Color(4);  // the farthest that is finite
  return distances;
}

/// How far apart the places are whose surroundings agree, around x: what two eyes do.
int decoded(const Picture& picture, int x, int y) {
  constexpr int kAround = 12;
  for (int apart = 60; apart < 110; ++apart) {
    const int left = x - apart / 2, right = left + apart;
    bool same = true;
    for (int i = -kAround; i <= kAround; ++i)
      for (int row = y - 2; row <= y + 2; ++row)
        same = same && picture.at(left + i, row) == picture.at(right + i, row);
    if (same) return apart;
  }
  return 0;
}

TEST(Stereogram, TwoEyesFindTheDepths) {
  const StereogramRules rules;
  const Picture picture = stereogram(steps(), rules);
  EXPECT_EQ(decoded(picture, 160, 30), separation(1, rules));
  EXPECT_EQ(decoded(picture, 240, 30), separation(0.5, rules));
  EXPECT_EQ(decoded(picture, 300, 7), separation(0, rules));
  EXPECT_EQ(decoded(picture, 160, 53), separation(0, rules));
}

TEST(Stereogram, APatternRepeatsToo) {
  Picture pattern(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      pattern.at(x, y) = Color((x * 7 + y * 13) % 31 / 31.0, (x * y) % 29 / 29.0, 0.5);
  StereogramRules rules;
  rules.pattern = &pattern;
  const Picture picture = stereogram(steps(), rules);
  EXPECT_EQ(decoded(picture, 160, 30), separation(1, rules));
  EXPECT_EQ(picture.at(399, 0), pattern.at(399 % 32, 0));
}

TEST(Stereogram, WhatOneEyeCannotSeeIsLeftFree) {
  // A bar, far in front, hides what is behind its edges from one eye each.
  std::vector<double> row(400, 0.0);
  for (std::size_t x = 180; x < 220; ++x) row[x] = 1;
  StereogramRules rules;
  std::vector<double> flat(400, 0.0);
  const auto links = [&](const std::vector<double>& z) {
    const std::vector<int> same = linkedPlaces(z, rules);
    int n = 0;
    for (int x = 0; x < 400; ++x) n += same[static_cast<std::size_t>(x)] != x;
    return n;
  };
  EXPECT_EQ(links(flat), 400 - 90) << "all but the last have the next to the right";
  EXPECT_LT(links(row), links(flat));
  // Behind the bar's edge, at z = 0: hidden up to mu E / (2 (2 - mu 0)) = 15 pixels from it.
  const std::vector<int> same = linkedPlaces(row, rules);
  EXPECT_EQ(same[170 - 45], 170 - 45) << "10 pixels from the edge, hidden";
  EXPECT_EQ(same[160 - 45], 160 + 45) << "20 pixels from it, seen";
}

TEST(Stereogram, SameDotsForTheSameSeed) {
  StereogramRules rules, other;
  other.seed = 1;
  EXPECT_EQ(stereogram(steps(), rules), stereogram(steps(), rules));
  EXPECT_NE(stereogram(steps(), rules), stereogram(steps(), other));
}

TEST(Stereogram, ASceneWithoutDepthIsAFlatWall) {
  const Picture flat = stereogram(Picture(300, 20), {});
  EXPECT_EQ(decoded(flat, 150, 10), 90);
}

}  // namespace
}  // namespace trace
