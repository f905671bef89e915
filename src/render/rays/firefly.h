// Bright dots of paths that chance finds rarely: a limit to what one ray may add to a sample.
#pragma once

#include "image/srgb.h"
#include "render/rays/tracer.h"

namespace trace {

/// The part of what a bounced ray adds to the sample that Settings::fireflyLimit allows; the rest is counted.
inline Real allowedPart(Tracer& tracer, const Color& added) {
  const Real limit = tracer.settings().fireflyLimit, most = maxComponent(added);
  if (!(limit > 0) || !(most > limit)) return 1;
  const Real part = limit / most, removed = luminanceOf(added) * (1 - part);
  if (removed < 1e9)
    tracer.statistics().lightRemoved += static_cast<std::uint64_t>(removed * Statistics::kLightParts);
  return part;
}

}  // namespace trace
