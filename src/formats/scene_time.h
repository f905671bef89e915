// The moment at which a scene is read.
#pragma once

#include <algorithm>

#include "math/vec.h"

namespace trace {

/// A reader asks it for the time wherever the scene depends on that. So it knows afterwards whether the scene
/// may be another one at another moment, whatever in it moves.
class SceneTime {
 public:
  explicit SceneTime(Real seconds = 0) : seconds_(seconds) {}

  /// For a value that depends on it, in seconds.
  Real now() {
    asked_ = true;
    return seconds_;
  }
  /// now() was called.
  bool changesScene() const { return asked_; }

  /// A value changes by keys, of which this is the moment of the last.
  void hasKey(Real moment) { last_ = std::max(last_, moment); }
  /// The moment of the last key, in seconds; 0 if none comes after the start.
  Real last() const { return last_; }

 private:
  Real seconds_, last_ = 0;
  bool asked_ = false;
};

}  // namespace trace
