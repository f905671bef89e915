// What a view that is dragged leaves out.
#include "app/view/space/drag_pace.h"

#include <gtest/gtest.h>

namespace trace::test {
namespace {

TEST(DragPace, EachSomeLateFramesLeaveOutMore) {
  DragPace pace;
  for (const Left left : {Left::nothing, Left::triangles, Left::pixels, Left::pixels}) {
    EXPECT_EQ(pace.after(true, 0.01), left);  // it stays so: the picture would flicker
    pace.after(true, 0.1);
    EXPECT_EQ(pace.after(true, 0.1), left);
    pace.after(true, 0.1);
  }
}

TEST(DragPace, AViewAtRestIsWholeAndTheNextDragBeginsAsTheLastEnded) {
  DragPace pace;
  for (int frame = 0; frame < 3; ++frame) pace.after(true, 0.1);
  EXPECT_EQ(pace.after(false, 0.1), Left::nothing);
  EXPECT_EQ(pace.after(true, 0.01), Left::triangles);
  pace.begin();
  EXPECT_EQ(pace.after(true, 0.01), Left::nothing);
}

TEST(DragPace, AFastViewLeavesNothingOut) {
  DragPace pace;
  for (int frame = 0; frame < 100; ++frame) EXPECT_EQ(pace.after(true, 0.02), Left::nothing);
}

}  // namespace
}  // namespace trace::test
