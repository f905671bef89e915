// The input of mouse and keyboard, kept in order until a frame sees it.
//
// A window system reports in one go all that happened since the last frame; when frames are slow that may be
// a whole double click, or Ctrl+A from the first key down to the last one up. A frame can see only one state
// of each button, so the queue gives each frame as much as keeps its meaning when it is seen at once.
#pragma once

#include <deque>
#include <vector>

namespace trace {

struct InputEvent {
  enum class Kind { pointer, leave, button, wheel, key, character, focus };

  Kind kind = Kind::pointer;
  double x = 0, y = 0;  ///< the pointer's place, or how far the wheel was turned
  int code = 0;         ///< code of the button, or of the key
  int writes = 0;     ///< character of a key: a capital letter for letters, '=' for plus; else the key's code
  bool down = false;  ///< whether a button or key was pressed, or the focus came
  bool repeat = false;                               ///< the key was down before
  bool modifier = false;                             ///< the key is Ctrl, Shift, Alt or Super
  bool control = false, shift = false, alt = false;  ///< were held
  unsigned character = 0;                            ///< that the key wrote, or that came without a key
  double time = 0;                                   ///< when it was reported, in seconds
  double slack = 0;                                  ///< so much earlier it may have happened

  /// An event that is not text: it may change the meaning of the keys after it.
  bool isCommand() const {
    return kind == Kind::key && down && !modifier && (!character || character == ' ');
  }
};

class InputQueue {
 public:
  /// A character is joined to the key that wrote it, if that came just before.
  void add(const InputEvent& event);
  /// The events that the next frame sees, in order; empty if there are none.
  std::vector<InputEvent> takeFrame();
  bool empty() const { return events_.empty(); }

 private:
  std::deque<InputEvent> events_;
};

}  // namespace trace
