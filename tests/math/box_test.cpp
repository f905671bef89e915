#include "math/box.h"

#include <gtest/gtest.h>

namespace trace {
namespace {

TEST(Box, IsEmptyAsMade) {
  EXPECT_TRUE(Box3{}.empty());
  EXPECT_FALSE(Box3{}.unbounded());
  EXPECT_FALSE(Box3{}.contains({0, 0, 0}));
  EXPECT_EQ(Box3{}.size(), Vec3{});
  EXPECT_EQ(halfArea(Box3{}), 0);
}

TEST(Box, GrowsByPointsAndBoxes) {
  Box3 box;
  box.extend(Vec3{1, 2, 3});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.size(), Vec3{});
  EXPECT_TRUE(box.contains({1, 2, 3}));
  box.extend(Box3{{-1, 5, 0}, {0, 6, 0}});
  EXPECT_EQ(box, (Box3{{-1, 2, 0}, {1, 6, 3}}));
  EXPECT_EQ(box.center(), (Vec3{0, 4, 1.5}));
  EXPECT_EQ(halfArea(box), 2 * 4 + 4 * 3 + 3 * 2);
  box.extend(Box3{});
  EXPECT_EQ(box, (Box3{{-1, 2, 0}, {1, 6, 3}}));
}

TEST(Box, HoldsItsSidesAndNothingBeyond) {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(box.contains({0, 2, 3}));
  EXPECT_FALSE(box.contains({0, 2.0000001, 3}));
  EXPECT_FALSE(box.contains({-1e-300, 1, 1}));
}

TEST(Box, MayGoOnForEver) {
  EXPECT_TRUE((Box3{{-kInfinity, 0, 0}, {kInfinity, 0, 0}}).unbounded());
  EXPECT_FALSE((Box3{{-1e300, 0, 0}, {1e300, 0, 0}}).unbounded());
  EXPECT_EQ((Box3{{-1e308, 0, 0}, {1.5e308, 0, 0}}).center().x, 0.25e308);  // without an overflow
}

}  // namespace
}  // namespace trace
