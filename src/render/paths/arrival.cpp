#include "render/paths/arrival.h"

namespace trace {
namespace {

Footprint footprintAt(const Leg& leg, const Hit& hit) {
  const Differentials* differentials = leg.footprint.get();
  return differentials ? arrivedAt(hit, *differentials, leg.ray.direction) : Footprint();
}

}  // namespace

Arrival::Arrival(Tracer& tracer, const Leg& leg, const Hit& hit, Turn& turn, Real spread)
    : footprint(footprintAt(leg, hit)), at(tracer, leg.ray, hit, footprint.get(), leg.inside, spread) {
  if (leg.within)
    at.letIn();
  else if (tracer.world().hasSubsurface())
    body = at.takeBody();
  turn.sum.note(at.bsdf());
  turn.sum.note(at.raised());
  turn.sum.note(at.indices);
}

}  // namespace trace
