#include "app/input/fingers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/elementary.h"

namespace trace {
namespace {

constexpr int kLeftButton = 0, kRightButton = 1, kMiddleButton = 2;
constexpr double kLeastBetween = 1;  // pixels

}  // namespace

void Fingers::take(const Touch& touch, bool scrolls, const Lengths& lengths) {
  switch (touch.kind) {
    case Touch::Kind::down: down({touch.finger, touch.x, touch.y}, scrolls); break;
    case Touch::Kind::move: move({touch.finger, touch.x, touch.y}, lengths); break;
    case Touch::Kind::up: up(touch.finger); break;
    case Touch::Kind::cancel:
      if (state_ == State::undecided) state_ = State::spent;
      up(touch.finger);
      break;
  }
}

void Fingers::look(double time) {
  constexpr double kMostOfFrame = 0.1;
  if (looked_) rested_ += std::min(time - *looked_, kMostOfFrame);
  looked_ = time;
  if (state_ != State::undecided || rested_ < kRest) return;
  button(kRightButton, true);
  button(kRightButton, false);
  state_ = State::spent;
}

std::vector<InputEvent> Fingers::events() { return std::exchange(events_, {}); }

void Fingers::down(const Finger& finger, bool scrolls) {
  fingers_.push_back(finger);
  if (fingers_.size() == 1) {
    state_ = State::undecided;
    start_ = finger;
    looked_.reset();
    rested_ = 0;
    scrollable_ = scrolls;
    return point(finger.x, finger.y);
  }
  if (fingers_.size() == 2 && state_ != State::spent) {
    letGo();
    const Finger at = middle();
    point(at.x, at.y);
    if (!scrollable_) button(kMiddleButton, true);
    state_ = scrollable_ ? State::pairScrolls : State::pair;
  } else {
    letGo();
    state_ = State::spent;
  }
}

void Fingers::move(const Finger& finger, const Lengths& lengths) {
  Finger* const known = find(finger.number);
  if (!known) return;
  const Finger before = *known, middleBefore = middle();
  const double apartBefore = apart();
  *known = finger;
  if (state_ == State::undecided) {
    const double x = finger.x - start_.x, y = finger.y - start_.y;
    if (math::hypot(x, y) < lengths.slip) return;
    // A list scrolls up and down: a finger that moves sideways drags what it is on.
    state_ = scrollable_ && std::abs(y) > std::abs(x) ? State::scrolls : State::drags;
    if (state_ == State::drags) button(kLeftButton, true);
  }
  switch (state_) {
    case State::drags: point(finger.x, finger.y); break;
    case State::scrolls: wheel(0, (finger.y - before.y) / lengths.notch); break;
    case State::pairScrolls: {
      const Finger at = middle();
      wheel((at.x - middleBefore.x) / lengths.notch, (at.y - middleBefore.y) / lengths.notch);
      break;
    }
    case State::pair: {
      const Finger at = middle();
      point(at.x, at.y);
      wheel(0, math::log(std::max(apart(), kLeastBetween) / std::max(apartBefore, kLeastBetween)) /
                   math::log(kNotch));
      break;
    }
    default: break;
  }
}

void Fingers::up(int number) {
  std::erase_if(fingers_, [&](const Finger& finger) { return finger.number == number; });
  if (state_ == State::undecided) {
    button(kLeftButton, true);
    button(kLeftButton, false);
  }
  letGo();
  state_ = fingers_.empty() ? State::idle : State::spent;
  if (fingers_.empty()) events_.push_back({.kind = InputEvent::Kind::leave});
}

Fingers::Finger* Fingers::find(int number) {
  const auto found = std::find_if(fingers_.begin(), fingers_.end(),
                                  [&](const Finger& finger) { return finger.number == number; });
  return found == fingers_.end() ? nullptr : &*found;
}

Fingers::Finger Fingers::middle() const {
  const Finger &a = fingers_.front(), &b = fingers_.back();
  return {0, (a.x + b.x) / 2, (a.y + b.y) / 2};
}

double Fingers::apart() const {
  return math::hypot(fingers_.back().x - fingers_.front().x, fingers_.back().y - fingers_.front().y);
}

void Fingers::point(double x, double y) {
  events_.push_back({.kind = InputEvent::Kind::pointer, .x = x, .y = y});
}

void Fingers::button(int code, bool down) {
  events_.push_back({.kind = InputEvent::Kind::button, .code = code, .down = down});
  held_ = down ? std::optional(code) : std::nullopt;
}

void Fingers::wheel(double x, double y) {
  if (x != 0 || y != 0) events_.push_back({.kind = InputEvent::Kind::wheel, .x = x, .y = y});
}

void Fingers::letGo() {
  if (held_) button(*held_, false);
}

}  // namespace trace
