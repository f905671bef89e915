// Events come in order and keep their meaning, however many happened since the last frame.
#include "app/input/input_queue.h"

#include <gtest/gtest.h>

#include <string>

namespace trace::test {
namespace {

using Kind = InputEvent::Kind;

constexpr int kControl = 341, kAlt = 342, kBackspace = 259, kSpace = 32;

InputEvent pointer(double x, double y) { return {.kind = Kind::pointer, .x = x, .y = y}; }
InputEvent button(bool down, int code = 0) { return {.kind = Kind::button, .code = code, .down = down}; }
InputEvent key(int code, bool down, bool control = false) {
  return {.kind = Kind::key,
          .code = code,
          .writes = code,
          .down = down,
          .modifier = code == kControl || code == kAlt,
          .control = control};
}
InputEvent character(unsigned c) { return {.kind = Kind::character, .character = c}; }
InputEvent repeated(int code) {
  InputEvent event = key(code, true);
  event.repeat = true;
  return event;
}

void type(InputQueue& queue, const std::string& text) {
  for (const char c : text) {
    queue.add(key(c, true));
    queue.add(character(static_cast<unsigned char>(c)));
    queue.add(key(c, false));
  }
}

std::string frameText(const std::vector<InputEvent>& frame) {
  std::string text;
  for (const InputEvent& event : frame) {
    if (!text.empty()) text += " ";
    switch (event.kind) {
      case Kind::pointer: text += "to " + std::to_string(static_cast<int>(event.x)); break;
      case Kind::leave: text += "leave"; break;
      case Kind::button: text += event.down ? "press" : "release"; break;
      case Kind::wheel: text += "wheel"; break;
      case Kind::focus: text += "focus"; break;
      case Kind::character: text += std::string("'") + static_cast<char>(event.character) + "'"; break;
      case Kind::key:
        text += (event.down ? "+" : "-") + std::to_string(event.code);
        if (event.character) text += std::string("'") + static_cast<char>(event.character) + "'";
    }
  }
  return text;
}

std::vector<std::string> frames(InputQueue& queue) {
  std::vector<std::string> all;
  while (!queue.empty()) all.push_back(frameText(queue.takeFrame()));
  return all;
}

using Frames = std::vector<std::string>;

TEST(InputQueue, ADoubleClickWithinOneFrameIsTwoClicks) {
  InputQueue queue;
  for (const InputEvent& event :
       {pointer(10, 10), pointer(20, 20), button(true), button(false), button(true), button(false)})
    queue.add(event);
  EXPECT_EQ(frames(queue), (Frames{"to 10 to 20", "press", "release", "press", "release"}));
}

TEST(InputQueue, APressHappensWhereAFrameBeforeSawThePointer) {
  InputQueue queue;
  for (const InputEvent& event :
       {pointer(10, 0), button(true), pointer(90, 0), button(false), pointer(50, 0)})
    queue.add(event);
  EXPECT_EQ(frames(queue), (Frames{"to 10", "press", "to 90 release", "to 50"}));
}

TEST(InputQueue, AControlKeyIsSeenWithItsControlHoweverTheFramesFall) {
  const std::vector<InputEvent> events{key(kControl, true), key('A', true, true), key('A', false, true),
                                       key(kControl, false)};
  for (std::size_t cut = 0; cut <= events.size(); ++cut) {
    InputQueue queue;
    bool control = false, a = false, together = false;
    const auto look = [&] {
      for (const InputEvent& event : queue.takeFrame()) (event.code == 'A' ? a : control) = event.down;
      together = together || (control && a);
    };
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (i == cut) look();
      queue.add(events[i]);
    }
    while (!queue.empty()) look();
    EXPECT_TRUE(together) << cut;
    EXPECT_FALSE(control || a) << cut;
  }
}

TEST(InputQueue, TextComesInOneFrameAndCommandsBetweenItInTheirTurn) {
  InputQueue queue;
  type(queue, "25");
  EXPECT_EQ(frames(queue), (Frames{"+50'2' -50 +53'5' -53"}));
  queue.add(key('2', true));
  queue.add(character('2'));
  queue.add(key('5', true));
  queue.add(character('5'));
  queue.add(key(kBackspace, true));
  queue.add(key(kBackspace, false));
  type(queue, "7");
  EXPECT_EQ(frames(queue), (Frames{"+50'2' +53'5'", "+259", "-259 +55'7' -55"}));
}

TEST(InputQueue, AClickIntoAFieldComesBeforeWhatIsTypedThere) {
  InputQueue queue;
  queue.add(button(true));
  queue.add(button(false));
  type(queue, "f");
  queue.add(button(true));
  EXPECT_EQ(frames(queue), (Frames{"press", "release", "+102'f' -102", "press"}));
}

TEST(InputQueue, TheSpaceBarIsBothACommandAndText) {
  InputQueue queue;
  queue.add(key(kSpace, true));
  queue.add(character(' '));
  queue.add(key('b', true));
  queue.add(character('b'));
  EXPECT_EQ(frames(queue), (Frames{"+32' '", "+98'b'"}));
}

TEST(InputQueue, ATapOfAltIsSeenDownAndUp) {
  InputQueue queue;
  queue.add(key(kAlt, true));
  queue.add(key(kAlt, false));
  EXPECT_EQ(frames(queue), (Frames{"+342", "-342"}));
}

TEST(InputQueue, AHeldKeyDoesNotPileUp) {
  InputQueue queue;
  queue.add(key(kBackspace, true));
  for (int i = 0; i < 100; ++i) queue.add(repeated(kBackspace));
  queue.add(key(kBackspace, false));
  EXPECT_LE(frames(queue).size(), 4u);
  for (int i = 0; i < 3; ++i) {  // but what a held letter writes is all written
    queue.add(repeated('x'));
    queue.add(character('x'));
  }
  EXPECT_EQ(frames(queue), (Frames{"+120'x' +120'x' +120'x'"}));
}

TEST(InputQueue, TheWheelTurnsWhereThePointerIsAndNotWhileAButtonChanges) {
  InputQueue queue;
  queue.add(pointer(5, 5));
  queue.add({.kind = Kind::wheel, .y = 1});
  queue.add({.kind = Kind::wheel, .y = 1});
  queue.add(pointer(60, 60));
  queue.add(button(true));
  queue.add({.kind = Kind::wheel, .y = 1});
  EXPECT_EQ(frames(queue), (Frames{"to 5 wheel wheel", "to 60", "press", "wheel"}));
}

TEST(InputQueue, AnEmptyQueueGivesAnEmptyFrame) {
  InputQueue queue;
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.takeFrame().empty());
}

}  // namespace
}  // namespace trace::test
