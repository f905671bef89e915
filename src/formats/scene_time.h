// The moment at which a scene is read.
#pragma once

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

 private:
  Real seconds_;
  bool asked_ = false;
};

}  // namespace trace
