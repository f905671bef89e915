// How often chains are at a sample. Any function will do that is not 0 where there is light, if what a sample
// brings is divided by it (Hoberock and Hart, Arbitrary Importance Functions for Metropolis Light Transport,
// 2010).
#pragma once

#include <cmath>
#include <span>

#include "math/vec.h"

namespace trace {

/// In proportion to the luminance up to kMost times its mean over the samples that found light, and by its
/// logarithm beyond: otherwise chains stay at the pixels of a small lamp that is seen, and leave others out.
class ChainTarget {
 public:
  static constexpr Real kMost = 4;

  ChainTarget() = default;
  explicit ChainTarget(std::span<const Real> lights) {
    Real sum = 0, lit = 0;
    for (const Real light : lights) {
      sum += light;
      lit += light > 0 ? 1 : 0;
    }
    if (lit > 0) limit_ = kMost * sum / lit;
  }
  Real of(Real light) const { return light > limit_ ? limit_ * (1 + std::log(light / limit_)) : light; }

 private:
  Real limit_ = kInfinity;
};

}  // namespace trace
