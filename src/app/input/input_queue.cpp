#include "app/input/input_queue.h"

#include <algorithm>

namespace trace {
namespace {

using Kind = InputEvent::Kind;

/// The input that a frame has taken so far.
class OneFrame {
 public:
  /// False if the event has to wait for the next frame.
  bool take(const InputEvent& event) {
    if (!fits(event)) return false;
    if (event.kind == Kind::pointer) moved_ = true;
    if (event.kind == Kind::button) button_ = true;
    if (event.kind == Kind::wheel) wheel_ = true;
    if (event.kind == Kind::focus) focus_ = true;
    if (event.kind == Kind::character || (event.kind == Kind::key && event.down && event.character))
      text_ = true;
    if (event.isCommand()) command_ = true;
    if (event.isCommand() || (event.modifier && event.down)) pressed_.push_back(event.code);
    any_ = true;
    return true;
  }

 private:
  bool fits(const InputEvent& event) const {
    if (focus_) return false;
    const bool keys = command_ || text_, mouse = button_ || wheel_;
    switch (event.kind) {
      case Kind::pointer:
      case Kind::leave: return !mouse;
      case Kind::button:
        // Dear ImGui presses what lies under others, as a tab does, only if the frame before saw the pointer
        // there.
        return !mouse && !keys && !(event.down && moved_);
      case Kind::wheel: return !button_ && !keys;
      case Kind::focus: return !any_;
      case Kind::character: return !mouse && !command_;
      case Kind::key: break;
    }
    if (!event.down && std::find(pressed_.begin(), pressed_.end(), event.code) != pressed_.end())
      return false;
    if (event.modifier) return !mouse && !keys;
    if (!event.down) return true;
    return !mouse && !command_ && !(event.isCommand() && text_);
  }

  bool moved_ = false, button_ = false, wheel_ = false, command_ = false, text_ = false, focus_ = false,
       any_ = false;
  std::vector<int> pressed_;  // keys that must be seen down; those that only wrote text need not
};

}  // namespace

void InputQueue::add(const InputEvent& event) {
  if (!events_.empty()) {
    InputEvent& last = events_.back();
    const bool writes = last.kind == Kind::key && last.down && !last.modifier && !last.character;
    if (event.kind == Kind::character && writes && !last.control && !last.alt) {
      last.character = event.character;
      return;
    }
    // A key that is held repeats faster than slow frames can take it: one repeat is enough to wait.
    const bool again = last.kind == Kind::key && last.repeat && last.code == event.code && !last.character;
    if (event.kind == Kind::key && event.repeat && again) return;
  }
  events_.push_back(event);
}

std::vector<InputEvent> InputQueue::takeFrame() {
  std::vector<InputEvent> taken;
  OneFrame frame;
  while (!events_.empty() && frame.take(events_.front())) {
    taken.push_back(events_.front());
    events_.pop_front();
  }
  return taken;
}

}  // namespace trace
