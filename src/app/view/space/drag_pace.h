// How much of a view is left out while it is dragged, so that it follows the hand.
#pragma once

#include <algorithm>

namespace trace {

/// Each step leaves out what those before it do, too.
enum class Left { nothing, triangles, pixels };  ///< pixels: half as many along each side

class DragPace {
 public:
  static constexpr double kAimed = 1.0 / 30;  ///< seconds for a frame

  /// Tells of a frame that took so long; says what the next one is to leave out. When some frames of a drag
  /// were late, that is one thing more. It stays so, or the view would flicker; the next drag begins with it.
  Left after(bool drags, double seconds) {
    if (!drags || seconds <= kAimed) {
      if (!drags) late_ = 0;
    } else if (++late_ == kPatience) {
      late_ = 0;
      leaves_ = std::min(leaves_ + 1, static_cast<int>(Left::pixels));
    }
    return drags ? static_cast<Left>(leaves_) : Left::nothing;
  }

  /// Another scene may be faster.
  void begin() { *this = {}; }

 private:
  static constexpr int kPatience = 3;  // frames
  int late_ = 0, leaves_ = 0;
};

}  // namespace trace
