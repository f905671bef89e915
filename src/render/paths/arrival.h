// The surface point where a leg of a path arrives, and the light that comes out of the body there.
#pragma once

#include <memory>
#include <utility>

#include "render/paths/subsurface.h"
#include "render/paths/walk.h"
#include "shading/materials/subsurface.h"

namespace trace {

struct Arrival {
  /// For the leg that was cast last and ends at `hit`; both and `turn` live longer. `spread` says where
  /// wavelengths lie.
  Arrival(Tracer& tracer, const Leg& leg, const Hit& hit, Turn& turn, Real spread);

  Footprint footprint;  ///< that of the ray, at the hit
  Interaction at;
  std::unique_ptr<const SubsurfaceBsdf> body;  ///< in which light spreads; none behind a leg in it
};

/// Light that leaves the body where it is seen, having entered it elsewhere: at several points where the path
/// has turned nowhere before, else perhaps at one. follow(leg, hit) is the radiance of the `leg` that ends at
/// `hit`, where the light entered.
template <class Follow>
class BodyLight {
 public:
  BodyLight(Gather& sum, const Arrival& seen, const Leg& leg, Branch numbers, const Follow& follow)
      : sum_(sum), seen_(seen), leg_(leg), numbers_(leg.numbers.branch(numbers)), follow_(follow) {}

  /// Adds that `part` of the light of one point.
  void add(std::uint32_t n, Real part) const {
    const Sampler own = numbers_.branch(n);
    const auto in = entrance(seen_.at, *seen_.body, leg_.weight, own.branch(0));
    if (!in) return;
    const Color factor = in->weight * part;
    Leg within{in->ray, leg_.inside, own.branch(1), RayKind::refraction};
    within.weight = leg_.weight * factor;
    within.within = true;
    sum_.add(factor, follow_(within, in->hit), in->how);
  }
  /// Adds that of several points, if it is `first` seen. Returns how much one more is worth to choose;
  /// nothing where there is no body.
  std::optional<Real> addFirst(bool first) const {
    if (!seen_.body) return {};
    if (!first) return maxComponent(seen_.body->albedo) * maxComponent(seen_.body->passes(seen_.at.cosine));
    const int points = seen_.at.tracer.settings().subsurfaceSamples;
    for (int n = 0; n < points; ++n) add(static_cast<std::uint32_t>(n), 1.0 / points);
    return 0;
  }
  /// Adds that of one point if the choice is the way through the body, where the path then ends.
  bool takes(const Onward& onward, Real choice) const {
    const Real likely = onward.goesIntoBody(choice);
    if (likely > 0) add(0, 1 / likely);
    return likely > 0;
  }

 private:
  Gather& sum_;
  const Arrival& seen_;
  const Leg& leg_;
  Sampler numbers_;
  const Follow& follow_;
};

}  // namespace trace
