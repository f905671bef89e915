// Directions by the brightness of the environment (render/world/sky_sums.h).
#pragma once

#include <memory>

#include "render/world/outside.h"
#include "render/world/sky_sums.h"

namespace trace {

class SkyTable {
 public:
  SkyTable() = default;
  /// The table of what bounced rays see. It is empty where they see nothing or the same everywhere, and also,
  /// unless the sky is found `onlyHere`, where it is nowhere much brighter than elsewhere: then there is
  /// nothing to be gained by a choice.
  SkyTable(const Outside& outside, int threads, bool onlyHere = false);

  bool empty() const { return !sums_; }
  /// A unit direction, chosen by two numbers from 0 up to 1.
  Vec3 choose(const Vec2& u) const;
  /// With which choose() gives the unit direction, per solid angle.
  Real density(const Vec3& direction) const;

 private:
  std::shared_ptr<const SkySums> sums_;
};

}  // namespace trace
