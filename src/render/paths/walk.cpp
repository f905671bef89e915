#include "render/paths/walk.h"

namespace trace {

void LegMedia::cross(Tracer& tracer, const Leg& leg, Real end, int places) {
  Sampler numbers = leg.numbers.branch(Branch::medium);
  way = throughMedia(tracer, leg.ray, end, leg.inside, places, leg.weight, numbers.branch(0));
  place = placeByChance(*way, leg.weight, numbers.next());
}

Turn& pushScattered(Turns& turns, Tracer& tracer, int depth, const Leg& leg, const LegMedia& media,
                    Real share) {
  Turn& turn = turns.push(tracer, depth, leg.ink);
  turn.passed = leg.inside.passed(media.place->t);
  const Color& glows = media.way->glows;
  if (!isBlack(glows)) turn.sum.add(Color(share), glows, MediumTerm{MediumTerm::What::glows});
  return turn;
}

void goOn(Leg& leg, Turn& turn, const MediumWay::Place& place, Real goes, const Vec2& u) {
  const auto [direction, density] = samplePhase(leg.ray.direction, place.forward, u);
  turn.scatters = MediumTerm{MediumTerm::What::follows, place.object, place.t, place.forward};
  bounce(leg, turn, {leg.ray.at(place.t), direction}, place.weight / goes, density);
}

void goOn(Leg& leg, Turn& turn, const Interaction& at, const Differentials* arrived, const Onward::Ray& next,
          const Color& factor) {
  const World& world = at.tracer.world();
  const Vec3 along = leg.ray.direction;
  const bool bounces = next.kind == RayKind::bounce;
  turn.kind = termOf(next.kind);
  turn.limited = bounces;
  turn.factor = factor;
  turn.weight = leg.weight = leg.weight * factor;
  leg.asked = bounces || (next.kind == RayKind::refraction && leg.asked && at.tracer.lightPasses(at.bsdf()));
  leg.within = false;
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
