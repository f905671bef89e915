// The interface of those that end paths early, because they know light that paths would find: photons
// (integrators/photon.h).
#pragma once

#include "render/media/media.h"
#include "render/paths/interaction.h"

namespace trace {

class Terminator {
 public:
  virtual ~Terminator() = default;

  /// The state that a path carries for it.
  struct Told {
    std::size_t maps = 0;  ///< which of several sets of photons
    bool gathers = false;  ///< they tell all light of the vertex where it arrives
    bool all = false;      ///< they told what is scattered there already where it comes from
    Real apart = 0;        ///< except for what a surface as near as this sends evenly
    bool bounced = false;  ///< they were asked what mirrors and glass bring to where it was scattered
  };
  /// The light that is left to find at a vertex.
  struct Left {
    bool lamps = true;                 ///< the light of lamps, as that of the lights was asked for
    bool lobe = true;                  ///< what a ray into the lobe brings
    bool body = true;                  ///< what a way through the body brings
    bool bounced = true, sent = true;  ///< what rays bring that bounce, and those of mirrors and glass
    Told here{}, next{};               ///< for a way through the body, and for a bounced ray
    bool brings(RayKind kind) const { return kind == RayKind::bounce ? bounced : sent; }
  };

  /// For a path of the sample of that number.
  virtual Told begin(int sample) const = 0;
  /// The light of an emitter where such a ray arrives was counted before.
  virtual bool knowsEmitter(const Told& told, RayKind kind) const = 0;
  /// Adds the light of the lights and what it knows of all other light, at the end of a ray of that kind.
  virtual Left addLight(Gather& sum, const Interaction& at, const Told& told, RayKind kind,
                        const Sampler& numbers) const = 0;
  /// Adds what it knows of the light that a medium scatters there.
  virtual void addInMedium(Gather& sum, const ScatterPlace& at, const Told& told,
                           const Sampler& numbers) const = 0;
  /// The state of a path that continues with a ray of that kind.
  static Told onward(const Told& told, const Left& left, RayKind kind) {
    if (kind == RayKind::bounce) return left.next;
    Told next = told;
    next.apart = 0;
    return next;
  }
};

}  // namespace trace
