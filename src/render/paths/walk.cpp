#include "render/paths/walk.h"

namespace trace {

void goOn(Leg& leg, Turn& turn, const Interaction& at, const Differentials* arrived,
          const Onward::Ray& next) {
  const World& world = at.tracer.world();
  const Vec3 along = leg.ray.direction;
  const bool bounces = next.kind == RayKind::bounce;
  turn.kind = termOf(next.kind);
  turn.limited = bounces;
  if (!arrived || bounces)
    leg.footprint = {};
  else if (next.kind == RayKind::reflection)
    leg.footprint = mirroredAt(world, at.hit, arrived, along, at.normal);
  else
    leg.footprint = refractedAt(world, at.hit, arrived, along, next.direction, at.normal, next.ratio);
  leg.kind = next.kind;
  leg.ink = 0;
  if (next.behind) leg.inside = *next.behind;
  if (bounces)
    leg.ray = at.leaveToLight(next.direction);
  else
    leg.ray = at.hit.leave(next.direction);
}

}  // namespace trace
