// Light sampling of emitters, from points on surfaces and in media. All integrators sample in this way; they
// differ in the MIS weight of the light.
#pragma once

#include "render/media/media.h"

namespace trace {

/// The weight of the light of a point on an emitter, and how that is recorded: ChanceTerm, ConnectionTerm or
/// ScatteredTerm.
template <class Chance>
struct LampWeight {
  Color factor;
  Chance chance;
};

/// Light that a medium scatters; null: fog does.
struct ScatteredTerm {
  const MediumTerm* medium;
  ChanceTerm chance{};
};

inline void addLampLight(Gather& sum, const Color& factor, const Color& seen, const ChanceTerm& chance) {
  sum.add(Term::Kind::lamp, factor, seen, chance);
}
inline void addLampLight(Gather& sum, const Color& factor, const Color& seen, const ConnectionTerm& chance) {
  sum.addWay(Term::Kind::lamp, factor, seen, chance);
}
inline void addLampLight(Gather& sum, const Color& factor, const Color& seen,
                         const ScatteredTerm& scattered) {
  if (!scattered.medium) return sum.add(Term::Kind::fog, factor, seen);
  sum.add(factor * scattered.chance.share, seen, *scattered.medium, scattered.chance);
}

/// How the ray to an emitter asks: it ends at what it hits first, or it is a shadow ray that glass filters.
enum class LampRay { ends, filtered };

/// Which point of the emitters is asked: three random numbers.
struct LampChoice {
  Real which;
  Vec2 where;
};

/// Adds the light of one point on the emitters. `at` is the point that it arrives at: at.point(),
/// at.leave(direction) and at.side(direction), and for filtered rays at.visible(). weigh(place, alone) is the
/// LampWeight of the light, black to leave it out; `alone`: no ray that bounces can bring it. holes() draws a
/// number for holes on the way, and media() gives the numbers for media.
template <LampRay kRay = LampRay::ends, class At, class Holes, class Media, class Weigh>
void askLamp(Gather& sum, const Lamps& lamps, const At& at, const LampChoice& choice, const Holes& holes,
             const Media& media, const Weigh& weigh) {
  Tracer& tracer = sum.tracer();
  auto place = lamps.choose(at.point(), choice.which, choice.where);
  if (!place) return;
  auto weight = weigh(*place, false);
  if (isBlack(weight.factor)) return;
  const Ray ray = at.leave(place->toLight);
  Color seen;
  if constexpr (kRay == LampRay::filtered) {
    seen = at.visible(tracer, ray, place->distance * Lamps::kBefore, media());
  } else {
    const Real chance = tracer.world().hasHoles() ? holes() : 0;
    seen = lamps.look(tracer, ray, *place, at.side(place->toLight), chance);
    if (tracer.passedShadowless()) weight = weigh(*place, true);
    if (!tracer.world().media().empty() && !isBlack(seen))
      weight.factor *= passedByBodies(tracer, ray, place->distance, media());
  }
  addLampLight(sum, weight.factor, seen, weight.chance);
}

}  // namespace trace
