// When a view that is dragged is drawn with fewer pixels.
#include "app/view/drag_pace.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

TEST(DragPace, HalvesAfterSomeLateFramesUntilTheDragEnds) {
  DragPace pace;
  EXPECT_FALSE(pace.halves(true, 0.1));
  EXPECT_FALSE(pace.halves(true, 0.1));
  EXPECT_TRUE(pace.halves(true, 0.1));
  EXPECT_TRUE(pace.halves(true, 0.01));  // it stays so: the picture would flicker
  EXPECT_FALSE(pace.halves(false, 0.1));
  EXPECT_FALSE(pace.halves(true, 0.1));
}

TEST(DragPace, AFastViewKeepsItsPixels) {
  DragPace pace;
  for (int frame = 0; frame < 100; ++frame) EXPECT_FALSE(pace.halves(true, 0.02));
}

}  // namespace
}  // namespace trace::test
