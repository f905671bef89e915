// The radiance that one ray brings back, summed term by term.
//
// An integrator makes one for each ray it follows, after it has cast it, and adds the terms of its equation
// in order. When a RayTree is attached to the Tracer, the terms are written to the ray's node: what is
// recorded is what is summed.
#pragma once

#include "render/rays/tracer.h"

namespace trace {

class Gather {
 public:
  /// Gathers for the ray cast last. Rays that are cast while this lives are its children.
  Gather(Tracer& tracer, int depth) : tracer_(tracer), node_(tracer.enter()) {
    tracer.statistics().depths += static_cast<std::uint64_t>(depth);
  }
  ~Gather() { tracer_.leave(node_); }
  Gather(const Gather&) = delete;
  Gather& operator=(const Gather&) = delete;

  Tracer& tracer() const { return tracer_; }

  /// sum += factor * value. A ray that was cast for the value is the one cast last.
  [[gnu::always_inline]] void add(Term::Kind kind, const Color& factor, const Color& value) {
    sum_ += factor * value;
    if (Tracer::recorded(node_)) tracer_.record(node_, {kind, factor, value});
  }
  void add(Term::Kind kind, const Color& value) { add(kind, Color(1), value); }
  /// Adds a value that was chosen at random.
  void add(Term::Kind kind, const Color& factor, const Color& value, const ChanceTerm& chance) {
    sum_ += factor * value;
    if (Tracer::recorded(node_)) tracer_.record(node_, {kind, factor, value, Tracer::kNoNode, {}, chance});
  }
  /// sum += factor * passed: of the world's light of that number arrives `arriving`, which the surface
  /// scatters; factor is their product, of which `passed` is not in shadow.
  void addLight(std::size_t light, const Illumination& arriving, const Scatter& scatter, const Color& factor,
                const Color& passed, Real share = 1, Real probability = 1) {
    sum_ += factor * passed;
    if (Tracer::recorded(node_))
      tracer_.record(node_,
                     {Term::Kind::light, factor, passed, Tracer::kNoNode,
                      LightTerm{tracer_.world().lightSource(light), arriving, scatter, share, probability}});
  }

  /// Notes that the world's light of that number gives nothing here.
  void noteDark(std::size_t light, DarkTerm::Why why) {
    if (!Tracer::recorded(node_)) return;
    Term term{Term::Kind::light, Color(0), Color(0)};
    term.dark = DarkTerm{why, tracer_.world().lightSource(light)};
    tracer_.record(node_, term);
  }

  /// Adds light that air or a medium scatters along the ray.
  void addScattered(std::size_t light, const Color& factor, const Color& passed,
                    const std::optional<MediumTerm>& medium) {
    Term term{medium ? Term::Kind::medium : Term::Kind::fog, factor, passed};
    term.medium = medium;
    term.scattered = tracer_.world().lightSource(light);
    add(term);
  }

  /// Adds the radiance of a light that the ray meets.
  void add(const World::Lamp& lamp) {
    add(Term::Kind::emissive, lamp.seen.color);
    stop(MetLight{lamp.light, lamp.seen.t});
  }

  /// Adds the value of a bidirectional path.
  void addWay(Term::Kind kind, const Color& factor, const Color& value, const ConnectionTerm& connection) {
    sum_ += factor * value;
    if (Tracer::recorded(node_))
      tracer_.record(node_, {kind, factor, value, Tracer::kNoNode, {}, {}, {}, connection});
  }

  /// Adds an estimate by photons.
  void add(Term::Kind kind, const Color& value, const PhotonTerm& photons) {
    sum_ += value;
    if (Tracer::recorded(node_))
      tracer_.record(node_, {kind, Color(1), value, Tracer::kNoNode, {}, {}, photons});
  }

  /// Adds light that was computed before.
  void add(const Color& factor, const Color& value, const CacheTerm& cache) {
    add(Term{Term::Kind::irradiance, factor, value, Tracer::kNoNode, {}, {}, {}, {}, {}, {}, cache});
  }

  /// sum += factor * value of a medium, whose light may be chosen at random.
  void add(const Color& factor, const Color& value, const MediumTerm& medium,
           const std::optional<ChanceTerm>& chance = {}) {
    add(Term{Term::Kind::medium, factor, value, Tracer::kNoNode, {}, chance, {}, {}, medium});
  }
  /// Adds an estimate by photons.
  void add(const Color& factor, const Color& value, const MediumTerm& medium, const PhotonTerm& photons) {
    add(Term{Term::Kind::medium, factor, value, Tracer::kNoNode, {}, {}, photons, {}, medium});
  }
  /// Adds light that leaves a translucent object; it was cast last where it enters.
  void add(const Color& factor, const Color& value, const BodyTerm& body) {
    add(Term{Term::Kind::subsurface, factor, value, Tracer::kNoNode, {}, {}, {}, {}, {}, body});
  }
  /// Scales the terms added so far, behind a medium.
  void dim(const Color& passes, const MediumTerm& medium) { add(Color(1) + passes * -1, sum_ * -1, medium); }

  /// Something covers so much of what has been added.
  void cover(Term::Kind kind, Real share) {
    if (share > 0) add(kind, Color(share), sum_ * -1);
  }
  /// An outline does.
  void draw(Real ink) { cover(Term::Kind::outline, ink); }

  /// Notes what the place that was hit does with light.
  void note(const Bsdf& bsdf) {
    if (Tracer::recorded(node_)) tracer_.record(node_, bsdf);
  }
  /// Notes the indices of refraction at the hit.
  void note(const Indices& indices) {
    if (Tracer::recorded(node_)) tracer_.record(node_, indices);
  }
  /// Notes Interaction::raised().
  void note(const std::optional<Vec3>& raised) {
    if (Tracer::recorded(node_)) tracer_.record(node_, raised);
  }
  /// Notes why a ray is not continued: one of RayEnd.
  template <class Why>
  void stop(const Why& why) {
    if (Tracer::recorded(node_)) tracer_.record(node_, RayEnd(why));
  }

  /// The sum, after a medium of which `through` is not absorbed. The last thing to ask.
  Color radiance(const Color& through = Color(1)) const {
    const Color radiance = sum_ * through;
    if (Tracer::recorded(node_)) tracer_.record(node_, through, radiance);
    return radiance;
  }

 private:
  void add(const Term& term) {
    sum_ += term.factor * term.value;
    if (Tracer::recorded(node_)) tracer_.record(node_, term);
  }

  Tracer& tracer_;
  int node_;
  Color sum_;
};

}  // namespace trace
