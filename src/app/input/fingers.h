// Fingers on a screen, as the mouse that the studio knows.
//
// A tap clicks, a finger that moves drags, and one that rests presses the right button. Two fingers zoom as
// the wheel does, and drag with the middle button. Over lists one finger or two turn the wheel instead, which
// scrolls. A finger is not taken for a button before it moves, rests or leaves: the second one may be late.
#pragma once

#include <optional>
#include <vector>

#include "app/input/input_queue.h"

namespace trace {

/// One change of a finger.
struct Touch {
  enum class Kind { down, move, up, cancel };

  Kind kind = Kind::down;
  int finger = 0;       ///< its number
  double x = 0, y = 0;  ///< in pixels of the window
};

class Fingers {
 public:
  /// Lengths of the screen, in pixels.
  struct Lengths {
    double slip = 8;    ///< a finger that moves less rests
    double notch = 80;  ///< the length of a list that a notch of the wheel scrolls
  };

  /// `scrolls`: a list lies under the finger.
  void take(const Touch& touch, bool scrolls, const Lengths& lengths);
  /// Notices a finger that rests. To be called in each frame, with the time in seconds. Slow frames count
  /// little: perhaps the finger has left, and the browser reports it later.
  void look(double time);
  /// The events of a mouse that stand for all since the last call.
  std::vector<InputEvent> events();
  /// Some are on the screen.
  bool any() const { return !fingers_.empty(); }

  static constexpr double kRest = 0.5;   ///< seconds until a finger that rests is the right button
  static constexpr double kNotch = 1.2;  ///< fingers that are so many times as far apart turn the wheel by 1

 private:
  enum class State { idle, undecided, drags, scrolls, pair, pairScrolls, spent };
  struct Finger {
    int number;
    double x, y;
  };

  void down(const Finger& finger, bool scrolls);
  void move(const Finger& finger, const Lengths& lengths);
  void up(int number);
  Finger* find(int number);
  Finger middle() const;
  double apart() const;

  void point(double x, double y);
  void button(int code, bool down);
  void wheel(double x, double y);
  void letGo();

  State state_ = State::idle;
  std::vector<Finger> fingers_;
  Finger start_{};                  // where the first one came down
  std::optional<double> looked_{};  // at it last
  double rested_ = 0;               // seconds
  bool scrollable_ = false;         // what is under it
  std::optional<int> held_{};       // button of the mouse
  std::vector<InputEvent> events_;
};

}  // namespace trace
