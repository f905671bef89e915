// Whether a view that is dragged is drawn with fewer pixels, so that it follows the hand.
#pragma once

namespace trace {

class DragPace {
 public:
  static constexpr double kAimed = 1.0 / 30;  ///< seconds for a frame

  /// Tells of a frame that took so long. True if the next one is to have half as many pixels along each side:
  /// some frames of this drag were late.
  bool halves(bool drags, double seconds) {
    if (!drags) {
      late_ = 0;
      return false;
    }
    if (seconds > kAimed && late_ < kPatience) ++late_;
    return late_ == kPatience;
  }

 private:
  static constexpr int kPatience = 3;  // frames
  int late_ = 0;
};

}  // namespace trace
