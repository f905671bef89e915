// Photons on their way: from where they start, off surfaces, through glass and through media, until they come
// to rest (Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, chapter 5; in media Jensen and
// Christensen, Efficient Simulation of Light Transport in Scenes with Participating Media using Photon Maps,
// 1998).
#pragma once

#include <utility>
#include <vector>

#include "math/low_discrepancy.h"
#include "render/maps/illumination_map.h"
#include "render/media/media.h"
#include "render/photons/photon_targets.h"
#include "render/rays/fog.h"
#include "render/samples/hashed_numbers.h"
#include "shading/materials/subsurface.h"

namespace trace {

class Interaction;

/// A source of photons: a light of the scene, the emissive objects, or the environment.
struct PhotonSource {
  enum class Kind { light, lamps, sky } kind;
  std::size_t light = 0;
  Real power = 0;          ///< about what it sends; only how many photons it gets depends on that
  std::int64_t count = 0;  ///< number of photons
};

/// The stored photons: on surfaces, in media, and on maps of surfaces.
struct LandedPhotons {
  std::vector<Photon> photons{};
  std::vector<Photon> inMedia{};
  std::vector<std::pair<IlluminationMap::Place, Color>> onMaps{};
};

/// Which photons surfaces keep.
enum class Kept {
  caustics,   ///< that mirrors and glass have thrown there, and nothing else; the rest ends where it is
              ///< scattered
  scattered,  ///< that something has scattered on the way
  all
};

class PhotonEmitter {
 public:
  /// Photons fly to the targets. With `texels`, caustics lie on maps of so many where a surface has one. Of
  /// others, media keep those that do not come straight: what does is asked for.
  PhotonEmitter(const World& world, const Settings& settings, const Lamps* lamps,
                std::vector<PhotonTarget> targets, Kept kept, int texels, int pass);

  /// Photon n of the source.
  void send(const PhotonSource& source, std::uint32_t n, LandedPhotons& landed);

 private:
  /// A photon on its way.
  struct Flight {
    Ray ray;
    Interfaces inside;
    std::optional<Hit> hit;
    Color power;
    bool parallel = false, fromSky = false;  ///< it comes straight from beyond all distances
    /// The number of a light of the scene; shadow rays, which cross panes that bend nothing, ask for it.
    const std::size_t* light = nullptr;
    Vec2 onLight{};               ///< the place on it
    std::optional<Vec3> start{};  ///< which is that point
    Real share = 0, count = 1;    ///< what of the light it stands for, and among how many
    Real law = 0;                 ///< what falls on the pane that it has crossed last
    int bounces = 0, scatterings = 0;
    int panes = 0;           ///< panes of the bounces, on the way straight from a light of the scene
    bool straight = true;    ///< it has hit nothing but panes that bend nothing
    bool asked = true;       ///< rays to lights bring it to media
    bool gathered = false;   ///< it is not what rays to lights bring
    bool scattered = false;  ///< by a surface, a body or a medium
    bool offSurface =
        false;  ///< a surface has sent it evenly on its way now, no mirror or lobe, light or medium
    bool mediumFirst = false;  ///< a medium scattered it before any surface did

    /// Nothing but panes is on its way so far.
    bool untouched() const { return bounces == panes && scatterings == 0; }
  };
  struct Chances {
    std::uint64_t bits = 0;
    Real next() { return unitFromBits(bits = mixBits(bits)); }
  };

  Vec2 pair(std::uint64_t dimension) const { return sobolPoint(n_, mixBits(seed_ ^ dimension)); }
  Real chance() { return chances_.next(); }
  Real hole() { return tracer_.chance(holes_); }

  std::optional<Flight> fromLight(const PhotonSource& source);
  std::optional<Flight> fromLamp(const PhotonSource& source);
  std::optional<Flight> fromSky(const PhotonSource& source);
  void cast(Flight& flight) { flight.hit = tracer_.cast(flight.ray, RayKind::bounce, flight.inside, hole()); }

  void fly(Flight& flight, LandedPhotons& landed);
  Color arriving(const Flight& flight, const Vec3& point, Real t) const;
  Real fallsOn(const Flight& flight, const Vec3& point) const;
  bool crossMedia(Flight& flight, LandedPhotons& landed);
  void lightFog(const Flight& flight, LandedPhotons& landed);
  bool counts(int scatterings, bool mediumFirst) const;
  bool rests(const Flight& flight) const;
  void scatter(Flight& flight, const Vec3& point, Real forward);
  bool goOn(Flight& flight, const Interaction& at, bool scattersIt, const SubsurfaceBsdf* body);

  std::uint64_t seedOfPass_;  ///< 0 of the first
  const World& world_;
  const Settings& settings_;
  const Lamps* lamps_;
  std::vector<PhotonTarget> targets_;
  Kept kept_;
  bool onlyCaustics_;
  Fog fog_;
  Tracer tracer_;
  IlluminationMap texels_;  // tells where on it a place is
  SampleRules rules_;       // what samplers want
  HashedNumbers numbers_;
  // The photon that is sent now.
  std::uint64_t seed_ = 0;
  std::uint32_t n_ = 0;
  Chances chances_, holes_;
};

}  // namespace trace
