// Pictures of differences, pixel by pixel.
#include "image/comparison/difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "image/comparison/false_color.h"

namespace trace {
namespace {

Picture shown(std::string_view name, const Picture& a, const Picture& b, double magnify,
              const std::vector<double>& flip = {}) {
  for (const Show& show : shows())
    if (show.name == name) return show.picture({a, b, flip}, magnify);
  ADD_FAILURE() << name;
  return {};
}

class DifferenceTest : public testing::Test {
 protected:
  DifferenceTest() {
    a_.at(0, 0) = {1, 0.5, 0};
    b_.at(0, 0) = {0.75, 0.75, 0};
  }
  Picture a_ = Picture(2, 1), b_ = Picture(2, 1);
};

TEST_F(DifferenceTest, Absolute) {
  EXPECT_EQ(shown("absolute", a_, b_, 2).at(0, 0), Color(0.5, 0.5, 0));
  EXPECT_EQ(shown("absolute", a_, b_, 8).at(0, 0), Color(1, 1, 0));
  EXPECT_EQ(shown("absolute", a_, b_, 2).at(1, 0), Color(0));
}

TEST_F(DifferenceTest, SignedSaysWhichIsBrighter) {
  EXPECT_EQ(shown("signed", a_, b_, 2).at(0, 0), Color(0.25, 0.75, 0.5));
  EXPECT_EQ(shown("signed", a_, b_, 100).at(0, 0), Color(0, 1, 0.5));
  a_.at(1, 0) = Color(std::nan(""));
  EXPECT_EQ(shown("signed", a_, b_, 1).at(1, 0), Color(1));
}

TEST_F(DifferenceTest, HeatAndFlipAreFalseColours) {
  EXPECT_EQ(shown("heat", a_, b_, 2).at(0, 0), heatColor(0.5));
  EXPECT_EQ(shown("heat", a_, b_, 2).at(1, 0), Color(0));
  EXPECT_EQ(shown("flip", a_, b_, 2, {0.25, 1}).at(0, 0), heatColor(0.25));
  EXPECT_EQ(shown("flip", a_, b_, 2, {0.25, 1}).at(1, 0), Color(1));
}

TEST_F(DifferenceTest, SizesMustAgree) { EXPECT_THROW(shown("heat", a_, Picture(1, 2), 1), Error); }

}  // namespace
}  // namespace trace
