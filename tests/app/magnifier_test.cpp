// The presenter's magnifying glass, and marks at the edge of a view.
#include "app/view/magnifier.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

TEST(Magnifier, TextOnTheStageGrowsWithTheWindow) {
  EXPECT_EQ(stageScale(400), stageScale(640));
  EXPECT_NEAR(stageScale(1080) / stageScale(720), 1.5, 1e-12);
  EXPECT_GT(16 * stageScale(1080) / 1080, 0.03);  // share of the height
}

TEST(Magnifier, KeepsWhatThePointerIsAt) {
  for (const Vec2 pointer : {Vec2{0, 0}, Vec2{300, 200}, Vec2{900, 600}})
    for (const int times : {1, 2, 4}) {
      const WindowPart part = magnified({900, 600}, pointer, times);
      EXPECT_NEAR(part.size.x * times, 900, 1e-9);
      EXPECT_NEAR((pointer.x - part.corner.x) * times, pointer.x, 1e-9);
      EXPECT_NEAR((pointer.y - part.corner.y) * times, pointer.y, 1e-9);
      EXPECT_GE(part.corner.x, 0);
      EXPECT_LE(part.corner.x + part.size.x, 900 + 1e-9);
    }
}

TEST(Magnifier, StaysInTheWindowWhenThePointerLeaves) {
  const WindowPart part = magnified({900, 600}, {-1e30, 1e30}, 2);
  EXPECT_EQ(part.corner, (Vec2{0, 300}));
}

TEST(Magnifier, GoesRound) {
  EXPECT_EQ(nextMagnification(1), 2);
  EXPECT_EQ(nextMagnification(2), 4);
  EXPECT_EQ(nextMagnification(4), 1);
}

TEST(EdgeMark, LiesOnTheEdgeTowardTheThing) {
  EXPECT_EQ(edgeMark({200, 100}, {1, 0}, 10), (Vec2{190, 50}));
  EXPECT_EQ(edgeMark({200, 100}, {0, -3}, 10), (Vec2{100, 10}));
  const Vec2 corner = edgeMark({200, 100}, {-50, 50}, 10);
  EXPECT_EQ(corner, (Vec2{60, 90}));
  EXPECT_EQ(edgeMark({200, 100}, {0, 0}, 10), (Vec2{100, 50})) << "no direction";
}

}  // namespace
}  // namespace trace::test
