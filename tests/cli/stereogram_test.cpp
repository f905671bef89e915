// ray stereogram.
#include <gtest/gtest.h>

#include "image/codecs/codec.h"
#include "program.h"

namespace trace::test {
namespace {

class StereogramCommand : public ProgramTest {
 protected:
  StereogramCommand() {
    write("ball.ray",
          "SBT-raytracer 1.0\ncamera { position = (0, 0, 4); }\nsphere { }\n"
          "point_light { position = (0, 0, 9); color = (1, 1, 1); }\n");
  }
};

TEST_F(StereogramCommand, HidesTheSceneInDots) {
  const Run r = run({"stereogram", "ball.ray", "-o", "dots.png", "-w", "300", "--dpi", "30"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(contains(r.last, "wrote dots.png (300x300, a stereogram)")) << r.last;
  const Picture dots = readPicture(path("dots.png"));
  // Eyes 75 pixels apart: 38 from repeat to repeat beside the ball, 30 where it is nearest.
  int beside = 0, nearest = 0;
  for (int x = 60; x < 90; ++x) beside += dots.at(x, 5) == dots.at(x + 38, 5);
  for (int x = 130; x < 140; ++x) nearest += dots.at(x, 150) == dots.at(x + 30, 150);
  EXPECT_EQ(beside, 30);
  EXPECT_EQ(nearest, 10);
  EXPECT_EQ(run({"stereogram", "ball.ray", "-o", "again.png", "-w", "300", "--dpi", "30", "-t", "2"}).code,
            0);
  EXPECT_EQ(readPicture(path("again.png")), dots);
}

TEST_F(StereogramCommand, RepeatsAPattern) {
  Picture pattern(8, 8);
  pattern.at(7, 3) = Color(1, 0, 0);
  writePicture(path("tile.png"), pattern);
  EXPECT_EQ(
      run({"stereogram", "ball.ray", "-o", "p.png", "-w", "160", "--dpi", "16", "--pattern", "tile.png"})
          .code,
      0);
  EXPECT_EQ(readPicture(path("p.png")).at(159, 3), Color(1, 0, 0));
}

TEST_F(StereogramCommand, SaysWhatIsWrong) {
  EXPECT_EQ(run({"stereogram", "ball.ray"}).code, 2);
  EXPECT_EQ(run({"stereogram", "ball.ray", "-o", "ball.ray"}).code, 2);
  EXPECT_EQ(run({"stereogram", "ball.ray", "-o", "d.png", "--pattern", "gone.png"}).code, 1);
  EXPECT_EQ(run({"stereogram", "ball.ray", "-o", "d.png", "--relief", "2"}).code, 2);
  EXPECT_TRUE(
      contains(run({"stereogram", "ball.ray", "-o", "d.png", "-w", "100"}).err, "less than four repeats"));
}

}  // namespace
}  // namespace trace::test
