// A presenter's magnifying glass: a part of the window fills all of it.
#pragma once

#include "math/vec.h"

namespace trace {

/// A part of the window, from its upper left corner, in pixels.
struct WindowPart {
  Vec2 corner, size;
};

/// The part that fills a window of that size when everything is so many times as large. What the pointer is
/// at stays where it is; so a click means what it shows. Precondition: times >= 1.
inline WindowPart magnified(const Vec2& window, const Vec2& pointer, Real times) {
  const Real rest = 1 - 1 / times;
  const auto within = [](Real x, Real most) { return x < 0 ? 0 : x > most ? most : x; };
  return {{within(pointer.x, window.x) * rest, within(pointer.y, window.y) * rest},
          {window.x / times, window.y / times}};
}

/// The next one: 1, 2, 4, and 1 again.
inline int nextMagnification(int times) { return times >= 4 ? 1 : 2 * times; }

/// How much larger everything is on a stage so many pixels high: text grows with the window.
inline Real stageScale(Real height) {
  constexpr Real kPlain = 1.6, kPlainHeight = 640;
  return height > kPlainHeight ? kPlain * height / kPlainHeight : kPlain;
}

/// The mark of something that a view of that size does not show, at its edge: the direction to it is from the
/// middle of the view.
inline Vec2 edgeMark(const Vec2& size, const Vec2& toward, Real margin) {
  const Vec2 half{size.x / 2 - margin, size.y / 2 - margin};
  const auto reach = [](Real room, Real by) { return by == 0 ? kInfinity : room / (by < 0 ? -by : by); };
  const Real x = reach(half.x, toward.x), y = reach(half.y, toward.y), far = x < y ? x : y;
  if (!(far < kInfinity)) return {size.x / 2, size.y / 2};
  return {size.x / 2 + toward.x * far, size.y / 2 + toward.y * far};
}

}  // namespace trace
