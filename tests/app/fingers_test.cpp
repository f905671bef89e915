// What fingers on a screen do, as events of a mouse.
#include "app/input/fingers.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace trace::test {
namespace {

/// The events in words: "at 10,20", "left down", "wheel 0,1.5", "leave".
std::string told(Fingers& fingers) {
  static constexpr const char* kButtons[] = {"left", "right", "middle"};
  std::string all;
  for (const InputEvent& event : fingers.events()) {
    char text[64];
    const auto pair = [&](const char* name) {
      std::snprintf(text, sizeof text, "%s%.3g,%.3g", name, event.x, event.y);
    };
    switch (event.kind) {
      case InputEvent::Kind::pointer: pair("at "); break;
      case InputEvent::Kind::wheel: pair("wheel "); break;
      case InputEvent::Kind::button:
        std::snprintf(text, sizeof text, "%s %s", kButtons[event.code], event.down ? "down" : "up");
        break;
      default: std::snprintf(text, sizeof text, "leave");
    }
    all += (all.empty() ? "" : "; ") + std::string(text);
  }
  return all;
}

class FingersTest : public ::testing::Test {
 protected:
  std::string take(Touch::Kind kind, int finger, double x, double y) {
    fingers.take({kind, finger, x, y}, scrolls, {.slip = 8, .notch = 50});
    return told(fingers);
  }
  Fingers fingers;
  bool scrolls = false;
};

TEST_F(FingersTest, ATapClicks) {
  EXPECT_EQ(take(Touch::Kind::down, 7, 10, 20), "at 10,20");
  EXPECT_EQ(take(Touch::Kind::move, 7, 12, 21), "") << "it slipped";
  EXPECT_EQ(take(Touch::Kind::up, 7, 12, 21), "left down; left up; leave");
  EXPECT_FALSE(fingers.any());
}

TEST_F(FingersTest, AMovingFingerDrags) {
  take(Touch::Kind::down, 0, 10, 20);
  EXPECT_EQ(take(Touch::Kind::move, 0, 10, 40), "left down; at 10,40");
  EXPECT_EQ(take(Touch::Kind::move, 0, 30, 40), "at 30,40") << "however slowly";
  EXPECT_EQ(take(Touch::Kind::up, 0, 30, 40), "left up; leave");
}

TEST_F(FingersTest, ARestingFingerIsTheRightButton) {
  take(Touch::Kind::down, 0, 10, 20);
  for (int frame = 0; frame < 5; ++frame) fingers.look(frame * 0.09);
  EXPECT_EQ(told(fingers), "");
  for (int frame = 5; frame < 7; ++frame) fingers.look(frame * 0.09);
  EXPECT_EQ(told(fingers), "right down; right up");
  EXPECT_EQ(take(Touch::Kind::move, 0, 90, 20), "");
  EXPECT_EQ(take(Touch::Kind::up, 0, 90, 20), "leave");
}

TEST_F(FingersTest, ASlowFrameMakesNoFingerRest) {
  take(Touch::Kind::down, 0, 10, 20);
  for (const double time : {0.0, 0.01, 2.0}) fingers.look(time);
  EXPECT_EQ(take(Touch::Kind::up, 0, 10, 20), "left down; left up; leave");
}

TEST_F(FingersTest, TwoZoomAndPan) {
  take(Touch::Kind::down, 0, 100, 100);
  EXPECT_EQ(take(Touch::Kind::down, 1, 200, 100), "at 150,100; middle down");
  EXPECT_EQ(take(Touch::Kind::move, 1, 220, 100), "at 160,100; wheel 0,1")
      << "they are 1.2 times as far apart";
  EXPECT_EQ(take(Touch::Kind::up, 1, 220, 100), "middle up");
  EXPECT_EQ(take(Touch::Kind::move, 0, 150, 100), "") << "the finger that is left does nothing";
  EXPECT_EQ(take(Touch::Kind::up, 0, 150, 100), "leave");
}

TEST_F(FingersTest, ASecondFingerEndsADrag) {
  take(Touch::Kind::down, 0, 100, 100);
  take(Touch::Kind::move, 0, 120, 100);
  EXPECT_EQ(take(Touch::Kind::down, 1, 220, 100), "left up; at 170,100; middle down");
  EXPECT_EQ(take(Touch::Kind::down, 2, 300, 300), "middle up") << "three mean nothing";
}

TEST_F(FingersTest, ListsScroll) {
  scrolls = true;
  take(Touch::Kind::down, 0, 100, 100);
  EXPECT_EQ(take(Touch::Kind::move, 0, 102, 75), "wheel 0,-0.5");
  EXPECT_EQ(take(Touch::Kind::move, 0, 300, 100), "wheel 0,0.5");
  EXPECT_EQ(take(Touch::Kind::up, 0, 300, 100), "leave");
  take(Touch::Kind::down, 0, 100, 100);
  EXPECT_EQ(take(Touch::Kind::move, 0, 120, 102), "left down; at 120,102")
      << "a slider of the list is dragged";
  take(Touch::Kind::up, 0, 120, 102);
  take(Touch::Kind::down, 0, 100, 100);
  EXPECT_EQ(take(Touch::Kind::down, 1, 200, 100), "at 150,100");
  EXPECT_EQ(take(Touch::Kind::move, 1, 200, 200), "wheel 0,1");
}

TEST_F(FingersTest, WhatTheSystemTakesAwayClicksNothing) {
  take(Touch::Kind::down, 0, 100, 100);
  EXPECT_EQ(take(Touch::Kind::cancel, 0, 100, 100), "leave");
  EXPECT_EQ(take(Touch::Kind::move, 3, 1, 1), "") << "a finger that never came";
}

}  // namespace
}  // namespace trace::test
