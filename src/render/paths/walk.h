// The walk of a path from the camera, turn by turn, and back again with the light that its last ray found:
//
//   L = gathered at the turn + factor * L of the rest
//
// One loop for path, photon and bdpt: in a medium a path may turn ten thousand times.
#pragma once

#include <optional>
#include <utility>

#include "base/inline_stack.h"
#include "render/media/media.h"
#include "render/paths/onward.h"
#include "render/rays/firefly.h"
#include "render/rays/gather.h"
#include "render/samples/integrator.h"
#include "render/world/footprint.h"

namespace trace {

/// The ray with which a path continues. Integrators add what else a path carries.
struct Leg {
  Leg(const Ray& ray_, Interfaces inside_, const Sampler& numbers_, RayKind kind_ = RayKind::camera)
      : ray(ray_), inside(std::move(inside_)), numbers(numbers_), kind(kind_) {}
  Leg(const CameraRay& camera, const Sampler& numbers_) : Leg(camera.ray, camera.inside, numbers_) {
    if (camera.differentials) footprint = *camera.differentials;
    ink = camera.ink;
  }

  Ray ray;
  Interfaces inside;  ///< what it starts in, and is in where it arrives
  Sampler numbers;    ///< numbers of the vertex that it comes from, then of that where it arrives
  RayKind kind = RayKind::camera;
  Footprint footprint{};  ///< none where none is wanted
  Real ink = 0;           ///< how much of it an outline covers
  Color weight{1};        ///< weight of its radiance in the sample
  bool within = false;    ///< it runs in a body, from where light comes out
  /// It was scattered, and has hit since then only panes that shadow rays pass: lights were asked.
  bool asked = false;
};

/// Where a leg ends: at a light of the scene that it sees, at the surface that it hits, or nowhere.
struct LegEnd {
  LegEnd(const World& world, const Leg& leg, const std::optional<Hit>& hit, bool seesLights)
      : lamp(seesLights && !leg.within ? world.lampAlong(leg.ray, hit ? hit->t : kInfinity) : std::nullopt),
        t(lamp  ? lamp->seen.t
          : hit ? hit->t
                : kInfinity) {}

  std::optional<World::Lamp> lamp;
  Real t;
};

/// A vertex of a path, until it is known what its rest brings.
struct Turn {
  Turn(Tracer& tracer, int depth, Real ink_) : sum(tracer, depth), ink(ink_) {}

  Gather sum;
  // The way that led here.
  Real ink;
  std::optional<MediumWay> media{};  ///< it is covered by
  Color passed{1};                   ///< transmittance of what it runs in
  // The rest of the path.
  Color factor{}, weight{};  ///< its share in this sum, and in the sample
  Real density = 0;          ///< density of its direction; 0 where there was one only
  Term::Kind kind = Term::Kind::bounce;
  bool limited = true;                   ///< Settings::fireflyLimit holds for it
  std::optional<MediumTerm> scatters{};  ///< a medium does, not a surface

  /// Adds what the rest brings.
  void add(const Color& light) {
    const Color counts = factor * (limited ? allowedPart(sum.tracer(), weight * light) : 1);
    const ChanceTerm chance{density, 0, 1};
    scatters ? sum.add(counts, light, *scatters, chance) : sum.add(kind, counts, light, chance);
  }
  /// The radiance along the ray that led here.
  Color radiance() {
    if (media) coverWithMedia(sum, *media);
    sum.draw(ink);
    return sum.radiance(passed);
  }
};

class Turns : public InlineStack<Turn, 8> {
 public:
  /// The path ends at the last turn: the radiance along the ray that led there.
  Color end() {
    const Color light = top().radiance();
    pop();
    return light;
  }
};

/// The media that a leg runs through up to its end, and where they scatter it, if they do.
struct LegMedia {
  /// The media may scatter the leg in so many `places`, 0 or 1.
  LegMedia(Tracer& tracer, const Leg& leg, Real end, int places) {
    if (isThick(tracer) && !leg.within) cross(tracer, leg, end, places);
  }
  std::optional<MediumWay> way{};  ///< none where there are no media
  std::optional<MediumWay::Place> place{};

 private:
  [[gnu::noinline]] void cross(Tracer& tracer, const Leg& leg, Real end, int places);
};

/// The turn of a path where a leg ends that media did not scatter.
inline Turn& pushArrived(Turns& turns, Tracer& tracer, int depth, const Leg& leg, LegMedia& media, Real end) {
  Turn& turn = turns.push(tracer, depth, leg.ink);
  turn.media = std::move(media.way);
  if (end < kInfinity && !leg.within) turn.passed = leg.inside.passed(end);
  return turn;
}
/// The turn of a path where media scatter it. `share` is the MIS weight of the light that they emit.
Turn& pushScattered(Turns& turns, Tracer& tracer, int depth, const Leg& leg, const LegMedia& media,
                    Real share = 1);
/// Whether a path continues with a ray of that kind, which carries light if it `brings` any; `limit` is the
/// depth that keeps it from being sent, if one does. Russian roulette lets `goes` of such paths continue, by
/// the number that draw() gives. Notes in `sum` why the path ends.
template <class Draw>
bool continues(Gather& sum, RayKind kind, const std::optional<int>& limit, bool brings, Real goes,
               const Draw& draw) {
  if (limit)
    sum.stop(DepthLimit{kind, *limit});
  else if (!brings)
    sum.stop(BelowThreshold{kind, 0, 0});
  else if (goes < 1 && !(draw() < goes))
    sum.stop(Roulette{kind, goes});
  else
    return true;
  return false;
}
/// The path continues with that ray in a random direction, whose light counts by `factor`.
inline void bounce(Leg& leg, Turn& turn, const Ray& ray, const Color& factor, Real density) {
  turn.factor = factor;
  turn.weight = leg.weight = leg.weight * factor;
  turn.density = density;
  leg.asked = true;
  leg.kind = RayKind::bounce;
  leg.footprint = {};
  leg.ink = 0;
  leg.ray = ray;
}
/// The path continues from there with the chance `goes`; two numbers choose its direction.
void goOn(Leg& leg, Turn& turn, const MediumWay::Place& place, Real goes, const Vec2& u);

/// The path continues with that ray, which `leg` becomes and whose light counts by `factor`; `arrived` is its
/// footprint at the turn, if there is one.
void goOn(Leg& leg, Turn& turn, const Interaction& at, const Differentials* arrived, const Onward::Ray& next,
          const Color& factor);

/// The radiance along the first leg, whose ray was cast last and ends at `hit`. arrive(hit, turns) is called
/// where a leg ends: it pushes a turn and makes `leg` the next, or gives the light of a path that ends there.
template <class Arrive>
Color walk(Tracer& tracer, Leg& leg, const std::optional<Hit>& first, const Arrive& arrive) {
  Turns turns;
  std::optional<Color> light = arrive(first, turns);
  while (!light) {
    const Real chance = tracer.world().hasHoles() ? leg.numbers.branch(Branch::hole).next() : 0;
    const std::optional<Hit> hit = tracer.cast(leg.ray, leg.kind, leg.inside, chance);
    leg.numbers = leg.numbers.branch(Branch::next);
    light = arrive(hit, turns);
  }
  while (!turns.empty()) {
    turns.top().add(*light);
    light = turns.end();
  }
  return *light;
}

}  // namespace trace
