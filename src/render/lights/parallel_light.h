// Where parallel light starts.
#pragma once

#include <algorithm>

#include "render/rays/tracer.h"

namespace trace {

/// From where light of that direction comes to the point: before all that it may meet on its way there. What
/// has an end lies behind the point; a plane may cross the way anywhere before it.
inline Vec3 startOfParallel(Tracer& tracer, const Vec3& point, const Vec3& direction) {
  Real farthest = 0;
  tracer.world().crossings({point, -direction}, kInfinity, Faces::both, tracer.statistics(),
                           [&](const Found& found) {
                             farthest = std::max(farthest, found.t);
                             return false;
                           });
  const Vec3 start = point - direction * (2 * farthest);
  return isFinite(start) ? start : point;
}

}  // namespace trace
